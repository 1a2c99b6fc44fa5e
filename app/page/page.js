// The page: what is clicked, typed, dragged or printed, and where the words stand.

const $ = (id) => document.getElementById(id);
const steps = () => [...document.querySelectorAll("#steps > li")];

let LOOKS, TEXTS, lesson, player;
let turn = REST;
let theme = "auto";
let pending = 0, before = 0, finer = 0;
const faults = [];

const isDark = () => (theme === "auto" ? matchMedia("(prefers-color-scheme: dark)").matches : theme === "dark");

/** Look again before the next frame. */
function refresh() {
  pending ||= requestAnimationFrame(frame);
}

function frame(now) {
  pending = 0;
  if (player.isMoving) player.tick(before ? Math.min(now - before, 100) : 0, now);
  before = player.isMoving ? now : 0;
  draw(player.going.way || fingers.size ? 1 : 2);
  if (player.isMoving) refresh();
}

function draw(fine) {
  const stage = $("stage"), shown = player.shown;
  const density = Math.min(devicePixelRatio || 1, 2);
  tell(shown); // first, for the words leave the stage its room
  const size = { wide: stage.clientWidth, tall: stage.clientHeight };
  const asked = askedAt(shown.still, player.going.way !== 0);
  const over = (pen, sights, point, paint) => drawSaid(pen, asked, sights, point, paint);
  drawPicture($("picture"), shown, { ...size, density, fine: fine / Math.max(density, 1), turn, over, isDark: isDark() });
}

// -- words ------------------------------------------------------------------------------------

let told = "", legendTold = "";

/** "Step 3 of 9", in the page's language. */
function spokenStep(number) {
  const words = document.querySelector("nav").dataset.step;
  return words.replace("{number}", number + 1).replace("{total}", lesson.stops.length);
}

/** The words that belong to what is shown. */
function tell({ still, corner, legend }) {
  const number = lesson.stops.indexOf(still);
  $("corner").textContent = corner;
  $("play").setAttribute("aria-pressed", String(player.isThrough));
  $("play").classList.toggle("playing", player.isThrough);
  tellLegend(legend);
  const asked = askedAt(still, player.going.way !== 0);
  const key = `${number} ${isDark()} ${asked?.said} ${asked?.isTold}`;
  if (told === key) return;
  told = key;
  const item = steps()[number];
  const copies = [...item.querySelectorAll(".caption, .formula")].map((each) => each.cloneNode(true));
  $("words").replaceChildren(...copies, ...askedWords(asked));
  $("picture").setAttribute("aria-label", `${spokenStep(number)}: ${lesson.captions[number]}`);
  $("count").textContent = `${number + 1} / ${lesson.stops.length}`;
  $("slider").value = number + 1;
  $("slider").setAttribute("aria-valuetext", spokenStep(number));
  $("first").disabled = $("back").disabled = number === 0;
  $("forward").disabled = $("last").disabled = number === lesson.stops.length - 1;
  steps().forEach((each, k) => each.toggleAttribute("aria-current", k === number));
  if (!testing) history.replaceState(null, "", `#step=${number + 1}`);
}

/** The legend: one entry for each kind of point in the picture. */
function tellLegend(entries) {
  const key = JSON.stringify([entries, isDark()]);
  if (legendTold === key) return;
  legendTold = key;
  const items = entries.map(([shape, colour, text]) => {
    const item = document.createElement("li");
    const mark = document.createElement("canvas");
    mark.width = mark.height = 44;
    mark.setAttribute("aria-hidden", "true");
    const [r, g, b] = lesson.palette[colour][isDark() ? 1 : 0];
    drawMark(mark.getContext("2d"), shape, 22, 22, 12, `rgb(${r} ${g} ${b})`);
    item.append(mark, text);
    return item;
  });
  $("legend").replaceChildren(...items);
}

// -- going on ---------------------------------------------------------------------------------

const KEYS = {
  " ": () => player.toggle(),
  ArrowRight: () => onward(1),
  PageDown: () => onward(1),
  ArrowLeft: () => onward(-1),
  PageUp: () => onward(-1),
  Home: () => jump(0),
  End: () => jump(player.last),
  "+": () => zoom(1.25),
  "-": () => zoom(0.8),
  r: () => seeFrom(REST),
};

const CLICK = 5; // pixels: a pointer that moves less has clicked

const TURNS = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

function onward(way) {
  player.pause();
  const beat = lookOf();
  if (way > 0) player.forward();
  else player.back();
  if (lookOf() !== beat) turn = REST;
}

function jump(stop) {
  const beat = lookOf();
  player.pause();
  player.go(stop);
  if (lookOf() !== beat) turn = REST;
}

/** From where the lesson sees it: another place than before undoes what the hand has turned. */
function lookOf() {
  return JSON.stringify(player.shown.panes.map((pane) => pane.camera));
}

function typed(event) {
  if (event.altKey || event.ctrlKey || event.metaKey) return;
  if (event.shiftKey && TURNS[event.key]) {
    const [across, down] = TURNS[event.key];
    rotate(0.06 * across, 0.06 * down);
  } else if (event.key === " " && event.target.closest("button, summary, a")) {
    return; // the button that has the focus is meant
  } else if (event.target.matches("input") && /^(Arrow|Home|End|Page)/.test(event.key)) {
    return; // the slider moves by itself
  } else if (/^[1-9]$/.test(event.key) && chooseAnswer(Number(event.key) - 1)) {
    return;
  } else if (KEYS[event.key]) {
    KEYS[event.key]();
  } else {
    return;
  }
  event.preventDefault();
}

/** A link such as #step=5 opens at a step; #step=5&at=0.4 at that part of the way to it. */
function fromAddress() {
  const asked = new URLSearchParams(location.hash.slice(1));
  const step = asked.get("step"), at = asked.get("at");
  if (step) jump(Number(step) - 1);
  if (at && lesson.legs[player.stop]) player.hold(player.stop, Number(at));
}

// -- turning ----------------------------------------------------------------------------------

const fingers = new Map();
let touched = null;

function seeFrom(there) {
  turn = there;
  refresh();
}

function rotate(across, down) {
  seeFrom({ ...turn, around: turn.around - Math.PI * across, over: turn.over + Math.PI * down });
}

function shift(across, down) {
  seeFrom({ ...turn, right: turn.right - across / turn.zoom, up: turn.up + down / turn.zoom });
}

function zoom(factor) {
  seeFrom({ ...turn, zoom: clamp(turn.zoom * factor, 0.15, 30) });
}

function pressed(event) {
  fingers.set(event.pointerId, [event.clientX, event.clientY]);
  touched = fingers.size === 1 ? [event.clientX, event.clientY] : null;
  $("stage").setPointerCapture(event.pointerId);
}

function moved(event) {
  const was = fingers.get(event.pointerId);
  if (!was) return;
  const here = [event.clientX, event.clientY], tall = $("stage").clientHeight;
  const across = (here[0] - was[0]) / tall, down = (here[1] - was[1]) / tall;
  fingers.set(event.pointerId, here);
  if (fingers.size === 2) {
    const other = [...fingers].find(([id]) => id !== event.pointerId)[1];
    const apart = (p) => Math.max(Math.hypot(p[0] - other[0], p[1] - other[1]), 1);
    shift(across / 2, down / 2);
    zoom(apart(here) / apart(was));
  } else if (event.shiftKey || event.buttons === 2 || player.shown.panes.every((pane) => pane.camera?.scale !== 0)) {
    shift(across, down);
  } else {
    rotate(across, down);
  }
}

function released(event) {
  const { left, top } = $("stage").getBoundingClientRect(), [x, y] = touched ?? [];
  const isClick = touched && event.type === "pointerup" && Math.hypot(event.clientX - x, event.clientY - y) < CLICK;
  if (isClick) pointAt(event.clientX - left, event.clientY - top);
  fingers.delete(event.pointerId);
  refresh();
}

// -- themes and paper -------------------------------------------------------------------------

function changeTheme() {
  theme = isDark() ? "light" : "dark";
  document.documentElement.dataset.theme = theme;
  refresh();
}

/** Every step as a picture beside its words, for paper. */
function printing() {
  const stop = player.stop, canvas = document.createElement("canvas");
  steps().forEach((item, k) => {
    player.stop = k;
    player.going = RESTING;
    const size = { wide: 800, tall: 460, density: 2, fine: 1, turn: REST, isDark: false, isPaper: true };
    drawPicture(canvas, player.shown, size);
    const image = document.createElement("img");
    image.className = "printed";
    image.alt = "";
    image.src = canvas.toDataURL();
    item.prepend(image);
  });
  player.stop = stop;
}

function printed() {
  document.querySelectorAll(".printed").forEach((image) => image.remove());
  refresh();
}

// -- a test of the page by itself -------------------------------------------------------------

const testing = location.hash === "#test";

/** Say something to a question, and read what the page makes of it beside the answer. */
function answeredWrongly(still, k) {
  player.go(k);
  draw(1);
  const { answers, truth, pane } = still.question;
  if (answers) {
    document.querySelectorAll(".asked button")[truth ? 0 : 1].click();
  } else {
    const stage = $("stage"), size = [stage.clientWidth, stage.clientHeight];
    const area = paneAreas(still.panes, ...size, pointOf(...size))[pane];
    const [x, y] = sightOf(still.panes[pane].camera, area, turn).project(truth);
    pointAt(x + 20, y);
  }
  player.go(lesson.stops.findLastIndex((stop) => stop.beat === still.beat + 1));
  draw(1);
  return document.querySelector("#words .asked").textContent;
}

/** Draw every stop and every leg, and write into the page what there was to see and what went wrong. */
function testAll() {
  const report = { stops: [], legs: 0, frames: 0, slowest: 0 };
  const timed = () => {
    const begin = performance.now();
    draw(1);
    report.slowest = Math.max(report.slowest, performance.now() - begin);
    report.frames += 1;
  };
  for (let k = 0; k <= player.last; k += 1) {
    player.go(k);
    timed();
    report.stops.push($("words").textContent.trim());
    if (!lesson.legs[k]) continue;
    report.legs += 1;
    for (const x of [0.01, 0.3, 0.49, 0.51, 0.77, 0.99]) {
      player.going = { leg: k, x, way: 1 };
      timed();
    }
  }
  report.asked = lesson.stops.flatMap((still, k) => (still.question ? [answeredWrongly(still, k)] : []));
  player.go(player.last);
  for (let k = 0; k < player.last; k += 1) player.back();
  player.settle();
  report.backAtTheFirst = player.stop === 0;
  report.keys = ["End", "Home", "PageDown", "ArrowRight", "PageUp", " ", " ", "r"].map((key) => {
    $("stage").dispatchEvent(new KeyboardEvent("keydown", { key, bubbles: true }));
    return [key, player.stop, player.going.way, player.isThrough];
  });
  report.requests = performance.getEntriesByType("resource").map((entry) => entry.name);
  report.faults = faults;
  const found = document.createElement("pre");
  found.id = "report";
  found.textContent = JSON.stringify(report);
  document.body.append(found);
}

// -- the beginning ----------------------------------------------------------------------------

function listen() {
  document.addEventListener("keydown", typed);
  const clicks = {
    first: () => jump(0), back: () => onward(-1), play: () => player.toggle(), forward: () => onward(1),
    last: () => jump(player.last), reset: () => seeFrom(REST), theme: changeTheme,
  };
  for (const [id, does] of Object.entries(clicks)) $(id).addEventListener("click", does);
  $("slider").addEventListener("input", (event) => jump(Number(event.target.value) - 1));
  const stage = $("stage");
  stage.addEventListener("pointerdown", pressed);
  stage.addEventListener("pointermove", moved);
  for (const name of ["pointerup", "pointercancel"]) stage.addEventListener(name, released);
  stage.addEventListener("dblclick", () => seeFrom(REST));
  stage.addEventListener("contextmenu", (event) => event.preventDefault());
  stage.addEventListener("wheel", (event) => {
    if (document.activeElement !== stage && !event.ctrlKey) return; // until it is clicked, the wheel scrolls the page
    event.preventDefault();
    zoom(Math.exp(-0.0015 * event.deltaY));
  }, { passive: false });
  new ResizeObserver(() => draw(2)).observe(stage); // before it is painted in its new size
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", refresh);
  addEventListener("hashchange", fromAddress);
  addEventListener("beforeprint", printing);
  addEventListener("afterprint", printed);
}

async function begin() {
  if (!("DecompressionStream" in window)) throw new Error("this browser is too old for the page: update it");
  lesson = new Lesson(await unpacked($("lesson").textContent));
  LOOKS = lesson.looks;
  for (const name of ["background", "ink", "muted", "guess"]) LOOKS[name] = lesson.palette[LOOKS[name]];
  TEXTS = lesson.texts;
  player = new Player(lesson, refresh);
  document.body.classList.add("ready");
  listen();
  fromAddress();
  if (testing) testAll();
  draw(2);
}

addEventListener("error", (event) => faults.push(event.message));
addEventListener("securitypolicyviolation", (event) => faults.push(`${event.violatedDirective} ${event.blockedURI}`));
begin().catch((fault) => {
  $("words").textContent = `The lesson could not be shown: ${fault.message}`;
  $("words").dataset.fault = fault.stack;
});
