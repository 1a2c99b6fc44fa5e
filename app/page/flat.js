// Type, and the flat strokes and marks of diagrams, on a canvas.

const LEAST_TYPE = 11;
const RIM = 0.28;

/** A line of type from `x` on the baseline `y`, with a rim that sets it off from what lies under it. */
function drawText(pen, number, x, y, size, style, rim) {
  const text = TEXTS[number];
  text.shape ??= new Path2D(text.path);
  pen.save();
  pen.translate(x, y);
  pen.scale(size / LOOKS.em, size / LOOKS.em);
  if (rim) {
    pen.lineWidth = RIM * LOOKS.em;
    pen.lineJoin = "round";
    pen.strokeStyle = rim;
    pen.stroke(text.shape);
  }
  pen.fillStyle = style;
  pen.fill(text.shape);
  pen.restore();
}

/** A line of type in the middle of a pane's width, smaller where it would not fit. */
function drawCentred(pen, number, area, y, size, style) {
  const wide = TEXTS[number].room[0];
  const held = Math.max(Math.min(size, (0.94 * area.wide) / Math.max(wide, 1e-9)), LEAST_TYPE);
  drawText(pen, number, area.x + area.wide / 2 - (wide * held) / 2, y, held, style);
}

/** The parts of a diagram, laid out for a pane of some size, as large as the pane here has room for. */
function drawFlat(pen, parts, area, paint) {
  const room = parts.find((part) => part.kind === "area");
  if (!room) return; // a scene with nothing flat in it
  const [wide, tall] = room.size;
  const scale = Math.min(area.wide / wide, area.tall / tall);
  pen.save();
  pen.translate(area.x + (area.wide - scale * wide) / 2, area.y + (area.tall - scale * tall) / 2);
  pen.scale(scale, scale);
  for (const part of parts) {
    if (!(part.kind in FLAT_PARTS) || part.opacity[0] <= 0) continue;
    pen.globalAlpha = Math.min(part.opacity[0], 1);
    FLAT_PARTS[part.kind](pen, part, paint);
  }
  pen.restore();
}

const FLAT_PARTS = {
  stroke(pen, part, paint) {
    const [x0, y0, x1, y1, width] = part.flat;
    const line = new Path2D();
    line.moveTo(x0, y0);
    line.lineTo(x1, y1);
    pen.save();
    pen.lineCap = "round";
    pen.lineWidth = width;
    pen.strokeStyle = paint(part.colour);
    if (part.dashed) pen.setLineDash([4 * width, 3 * width]);
    pen.stroke(line);
    pen.restore();
  },
  plate(pen, part, paint) {
    const [x, y, wide, tall, line, radius] = part.flat;
    const plate = new Path2D();
    plate.roundRect(x, y, wide, tall, radius);
    if (part.fill) {
      pen.fillStyle = paint(part.fill);
      pen.fill(plate);
    }
    if (part.stroke) stroke(pen, plate, line, paint(part.stroke));
  },
  mark(pen, part, paint) {
    const [x, y, size] = part.flat;
    drawMark(pen, part.shape, x, y, size, paint(part.colour));
  },
  text(pen, part, paint) {
    const [x, y, size] = part.flat;
    const anchor = { left: 0, center: 0.5, right: 1 }[part.align];
    const left = x - anchor * TEXTS[part.text].room[0] * size;
    drawText(pen, part.text, left, y, size, paint(part.colour), part.halo && paint(part.halo));
  },
};

/** A flat marker. */
function drawMark(pen, shape, x, y, size, style) {
  pen.save();
  pen.translate(x, y);
  pen.scale(size, size);
  for (const each of LOOKS.flat[shape]) {
    const path = new Path2D();
    if (each.corners) {
      each.corners.forEach((corner) => path.lineTo(...corner));
      path.closePath();
    } else {
      path.arc(0, 0, each.radius, 0, 2 * Math.PI);
    }
    if (each.width) {
      stroke(pen, path, each.width, style);
    } else {
      pen.fillStyle = style;
      pen.fill(path);
    }
  }
  pen.restore();
}
