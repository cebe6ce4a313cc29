// SPDX-License-Identifier: MIT
// Pointers take the sticks: each the tip that is nearer. While one plays and `both` says so, the other tip
// mirrors it across, and goes against it up and down. Places are to the left and up [m].
const HOME = { left: [0.4, 1.25], right: [-0.4, 1.25] };
const bounded = ([y, z]) => [Math.max(-1.2, Math.min(1.2, y)), Math.max(0.5, Math.min(2.2, z))];
function playByPointers(canvas, toWorld, wanted, both, moved = () => {}, plays = () => true) {
  const held = new Map();
  canvas.addEventListener("pointerdown", event => {
    if (!plays(event)) return;
    const at = toWorld(event), away = side => Math.hypot(at[0] - wanted[side][0], at[1] - wanted[side][1]);
    held.set(event.pointerId, away("left") < away("right") ? "left" : "right");
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", event => {
    const side = held.get(event.pointerId);
    if (!side) return;
    const to = bounded(toWorld(event)), other = side === "left" ? "right" : "left";
    const change = [to[0] - wanted[side][0], to[1] - wanted[side][1]];
    wanted[side] = to;
    if (both() && held.size === 1)
      wanted[other] = bounded([wanted[other][0] - change[0], wanted[other][1] - change[1]]);
    moved();
  });
  for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, event => held.delete(event.pointerId));
}
