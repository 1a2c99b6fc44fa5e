// A picture of the lesson at a place: its panes, drawn by their kind on one canvas.

/** Where the panes are when the picture has a size, words above and below them left out. */
function paneAreas(panes, wide, tall, point) {
  const above = panes.some((pane) => "title" in pane) ? LOOKS.type * point * 1.45 : 0;
  const below = panes.some((pane) => "reading" in pane) ? LOOKS.type * point * 1.45 : 0;
  const isUpright = wide < 0.9 * tall && panes.every((pane) => pane.rect[3] === 1);
  return panes.map((pane) => {
    const [x, y, w, h] = isUpright ? [0, pane.rect[0], 1, pane.rect[2]] : pane.rect;
    const top = y * tall + above;
    return { x: x * wide, y: top, wide: Math.max(w * wide, 1), tall: Math.max((y + h) * tall - below - top, 1) };
  });
}

/** A thousandth of the height of the whole picture, words included, for a stage so high. */
const pointOf = (wide, tall) => clamp(tall / 740, 0.5, Math.max(wide / 900, 0.62));

/**
 * Draw one instant.
 * `shown` has the panes and, for each of them, the parts that are there; `density` device pixels are a pixel;
 * `over` is called to draw what comes last; `fine` is how finely surfaces are drawn, in parts of a device pixel.
 */
function drawPicture(canvas, shown, { wide, tall, density, fine, turn, isDark, isPaper, over }) {
  canvas.width = Math.round(wide * density);
  canvas.height = Math.round(tall * density);
  const pen = canvas.getContext("2d");
  const point = pointOf(wide, tall);
  const theme = isDark ? 1 : 0;
  const paint = (colour, change = (c) => c) => `rgb(${colour[theme].map((c) => Math.round(change(c))).join(" ")})`;
  pen.setTransform(density, 0, 0, density, 0, 0);
  pen.fillStyle = isPaper ? "#fff" : paint(LOOKS.background);
  pen.fillRect(0, 0, wide, tall);
  const areas = paneAreas(shown.panes, wide, tall, point);
  const relief = new Relief(wide, tall, fine * density);
  const sights = shown.panes.map((pane, k) => pane.camera && sightOf(pane.camera, areas[k], turn));
  shown.parts.forEach((parts, k) => sights[k] && drawSurfaces(parts, sights[k], relief, theme));
  pen.drawImage(pictureOf(relief), 0, 0, wide, tall);
  shown.panes.forEach((pane, k) => {
    const area = areas[k];
    pen.save();
    pen.beginPath();
    pen.rect(area.x, area.y, area.wide, area.tall);
    pen.clip();
    if (sights[k]) drawScene(pen, shown.parts[k], sights[k], relief, point, paint);
    drawFlat(pen, shown.parts[k], area, paint);
    pen.restore();
    const size = Math.max(LOOKS.type * point, LEAST_TYPE);
    if ("title" in pane) drawCentred(pen, pane.title, area, area.y - 0.4 * size, size, paint(LOOKS.muted));
    if ("reading" in pane) drawCentred(pen, pane.reading, area, area.y + area.tall + 0.95 * size, size, paint(LOOKS.ink));
  });
  over?.(pen, sights, point, paint);
}

function sightOf(camera, area, turn) {
  const sight = new Sight(turned(fitted(camera, area), turn), area);
  const tangent = Math.tan((camera.angle * Math.PI) / 360);
  const far = length(minus(camera.position, camera.focal));
  sight.dash = (LOOKS.dash / 1000) * heightSeen({ ...camera, tangent }) * sight.perUnit(far / turn.zoom);
  return sight;
}

/** The solid surfaces, then the translucent ones over them. */
function drawSurfaces(parts, sight, relief, theme) {
  const surfaces = parts.filter((part) => part.kind === "faces");
  for (const part of surfaces.sort((a, b) => b.opacity[0] - a.opacity[0])) {
    relief.show({ ...part, colour: part.colour[theme] }, part.fan, sight);
  }
}

let held = null;

/** The surfaces as something a canvas can draw. */
function pictureOf(relief) {
  held ??= document.createElement("canvas");
  held.width = relief.columns;
  held.height = relief.rows;
  held.getContext("2d").putImageData(relief.image, 0, 0);
  return held;
}
