// Questions: what the reader says before the answer comes, and how near that was.

/** What was said, by the number of the beat that asks: a place in space, or the number of an answer. */
const said = new Map();

/** The question that a stop asks or answers, the number of its beat, and whether the answer is there. */
function askedAt(still, isMoving) {
  const beat = still.question ? still.beat : still.beat - 1;
  const question = lesson.stops.find((stop) => stop.question && stop.beat === beat)?.question;
  if (!question) return null;
  const isLast = lesson.stops.findLast((stop) => stop.beat === still.beat) === still;
  return { beat, question, isOpen: Boolean(still.question), isTold: !still.question && isLast && !isMoving, said: said.get(beat) };
}

/** Say something, or take it back by saying it again. */
function say(beat, prediction) {
  if (said.get(beat) === prediction) said.delete(beat);
  else said.set(beat, prediction);
  refresh();
}

/** Choose an answer by its number, if there is one to be chosen. */
function chooseAnswer(k) {
  const asked = askedAt(player.shown.still, false);
  if (!asked?.isOpen || !(k < asked.question.answers?.length)) return false;
  say(asked.beat, k);
  return true;
}

/** A click on the picture: a place where one is asked for, or a picture to choose. */
function pointAt(x, y) {
  const { panes, still } = player.shown, asked = askedAt(still, false);
  if (!asked?.isOpen) return;
  const { clientWidth: wide, clientHeight: tall } = $("stage"), { pane, truth, pictures, answers } = asked.question;
  const areas = paneAreas(panes, wide, tall, pointOf(wide, tall));
  const k = areas.findIndex((a) => x >= a.x && x < a.x + a.wide && y >= a.y && y < a.y + a.tall);
  if (pictures && k >= 0) say(asked.beat, k);
  if (!answers && k === pane) say(asked.beat, sightOf(panes[k].camera, areas[k], turn).place(x, y, truth));
}

/** What stands below the caption: answers to choose from, or what became of what was said. */
function askedWords(asked) {
  if (!asked) return [];
  const { question, beat } = asked;
  const line = document.createElement("p");
  line.className = "asked";
  if (asked.isOpen && question.answers) {
    line.append(...question.answers.map((words, k) => {
      const button = document.createElement("button");
      button.type = "button";
      button.textContent = words;
      button.setAttribute("aria-pressed", String(asked.said === k));
      button.addEventListener("click", () => say(beat, k));
      return button;
    }));
  } else if (asked.isOpen) {
    line.textContent = $("words").dataset.click;
  } else if (asked.isTold && asked.said !== undefined) {
    line.textContent = verdict(question, asked.said);
  }
  return line.hasChildNodes() ? [line] : [];
}

/** How near a prediction was, in the page's language. */
function verdict(question, prediction) {
  if (!question.answers) {
    const away = length(minus(prediction, question.truth)) / question.edge;
    return $("words").dataset.away.replace("{distance}", away.toFixed(2));
  }
  const yours = question.answers[prediction], truth = question.answers[question.truth];
  const { right, wrong } = $("words").dataset;
  return (prediction === question.truth ? right : wrong).replace("{yours}", () => yours).replace("{truth}", () => truth);
}

/** The place that was said, over the picture; with the answer, tied to it. */
function drawSaid(pen, asked, sights, point, paint) {
  if (!asked?.said?.length || !sights[asked.question.pane]) return;
  const sight = sights[asked.question.pane], size = LOOKS.pin * point;
  const [x, y] = sight.project(asked.said), [toX, toY] = sight.project(asked.question.truth);
  const colour = paint(LOOKS.guess);
  if (asked.isTold) {
    const line = new Path2D();
    line.moveTo(x, y);
    line.lineTo(toX, toY);
    stroke(pen, line, LOOKS.tie * point, colour);
  }
  pen.save();
  pen.globalAlpha = 0.6;
  drawMark(pen, "sphere", x, y, LOOKS.ground * size, "#fff");
  pen.restore();
  drawMark(pen, "aim", x, y, size, colour);
}
