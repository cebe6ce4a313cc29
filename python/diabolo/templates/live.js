// SPDX-License-Identifier: MIT
// The viewer plays live: frames come from the server, and it is told where the pointer wants the tips.
(() => {
"use strict";
const wanted = { ...HOME }, STATES = {
  on_string: ["taut", colors.goals], loose: ["slack", "#b45309"], flying: ["in flight", "#7c3aed"] };
const KEPT = 240;  // frames, for the trails
let seen = null, frames = 0, begin = null, sending = false, again = false;

// ---- from the server ----
const tracks = ["time", "left", "right", "diabolo", "orientation"];
const source = new EventSource("frames");
source.onmessage = event => {
  const frame = JSON.parse(event.data);
  if (seen && frame.stretch !== seen.stretch) for (const track of tracks) data[track].length = 0;
  seen = frame;
  for (const track of tracks) {
    data[track].push(frame[track]);
    if (data[track].length > KEPT) data[track].shift();
  }
  now = end = frame.time;
  element("note").textContent = "";
  if (!playing) draw();
  document.documentElement.dataset.frames = ++frames;
};
source.addEventListener("ended", event => {
  source.close();
  element("note").textContent = JSON.parse(event.data);
});
source.onerror = () => { element("note").textContent = "the connection is lost; is the program still there?"; };

// ---- to the server: one wish at a time, the latest ----
async function tell() {
  again = true;
  if (sending || source.readyState === EventSource.CLOSED) return;
  sending = true;
  while (again) {
    again = false;
    const speed = playing ? Number(element("speed").value) : 0;
    const body = JSON.stringify({ ...wanted, speed, begin });
    begin = null;
    try {
      await fetch("play", { method: "POST", headers: { "Content-Type": "application/json" }, body });
    } catch { again = false; }  // what is wrong is told by the stream
  }
  sending = false;
}
function beginBy(what) {
  if (what === "again") Object.assign(wanted, HOME);
  begin = what;
  tell();
}

// ---- the pointer, in the plane of the tips; with the right button or Shift it turns the view ----
const turns = event => event.button === 2 || event.shiftKey;
function toWorld(event) {
  const box = canvas.getBoundingClientRect(), focal = 1.1 * Math.min(1.2 * view.width, view.height);
  const x = (0.5 * box.width - event.clientX + box.left) * devicePixelRatio / focal;
  const up = (0.52 * box.height - event.clientY + box.top) * devicePixelRatio / focal;
  const [cy, sy, cp, sp] = [Math.cos(camera.yaw), Math.sin(camera.yaw), Math.cos(camera.pitch), Math.sin(camera.pitch)];
  const plane = data.left[0][0] - camera.middle[0] + camera.distance * cp * cy;
  const depth = plane / (cy * (cp + sp * up) - sy * x), ahead = cp * (depth - camera.distance) + sp * up * depth;
  return [camera.middle[1] + ahead * sy + x * depth * cy, camera.middle[2] + cp * up * depth - sp * (depth - camera.distance)];
}
const turn = canvas.onpointerdown;
canvas.onpointerdown = event => { if (turns(event)) turn(event); };
canvas.oncontextmenu = event => event.preventDefault();
playByPointers(canvas, toWorld, wanted, () => element("both").checked, tell, event => !turns(event));

// ---- what is shown ----
Object.assign(camera, { middle: [data.left[0][0], 0, 1.25], yaw: 0, pitch: 0.06, distance: 3 });
for (const id of ["time", "clock"]) element(id).hidden = true;
for (const [key, what, title] of [["r", "again", "start over (R)"], ["s", "spin", "spin (S)"]]) {
  const button = Object.assign(document.createElement("button"), { textContent: title, type: "button", id: what });
  button.onclick = () => { beginBy(what); button.blur(); };
  element("bar").append(button);
  addEventListener("keydown", event => {
    if (event.key.toLowerCase() === key && !event.repeat && !event.ctrlKey && !event.metaKey) beginBy(what);
  });
}
const choice = document.createElement("label");
choice.innerHTML = '<input id="both" type="checkbox" checked> one pointer moves both tips';
element("bar").append(choice, "Right button or Shift: turn the view.");
element("key").append(said("Drag a tip. To throw, part the tips fast. To catch, hold them wide apart under the diabolo."));
element("speed").value = "1";
element("speed").onchange = tell;
element("play").addEventListener("click", tell);
const drawView = draw;
draw = () => {
  drawView();
  if (!seen) return;
  const size = Math.min(30, canvas.clientWidth / 24), ratio = devicePixelRatio;
  const middle = 0.5 * canvas.width, below = (element("key").getBoundingClientRect().bottom + 1.3 * size) * ratio;
  text(`${seen.spin.toFixed(0)} rad/s`, middle - 0.5 * size * ratio, below, colors.diabolo, "right", size);
  const [state, color] = STATES[seen.string];
  text(state, middle + 0.5 * size * ratio, below, color, "left", size);
  const [across, height] = project(seen.diabolo);
  if (height < 0) text(`\u25b2 ${seen.diabolo[2].toFixed(1)} m`, across, below + 1.5 * size * ratio, colors.diabolo, "center", size);
  ["left", "right"].forEach((side, k) => {
    const [x, y] = project(seen[side]);
    text(`${seen.tensions[k].toFixed(1)} N`, x + (k ? 14 : -14) * ratio, y - 10 * ratio,
         colors[side], k ? "left" : "right", 0.7 * size);
  });
};
tell();
})();
