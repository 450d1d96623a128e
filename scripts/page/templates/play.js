"use strict";
// A reader moves delay, sensitivity and plane, and sees the motion of that place at once. Data and
// what they mean: scripts/page/play_data.py.

// The paths of a plane by the number of their point: time, u and ln v along each.
function pathsOf(plane) {
  const view = new DataView(Uint8Array.from(atob(plane.paths), (sign) => sign.charCodeAt(0)).buffer);
  const found = new Map();
  let at = 0;
  while (at < view.byteLength) {
    const [number, size] = [view.getUint32(at, true), view.getUint32(at + 4, true)];
    const [uLeast, uMost, lnVLeast, lnVMost] = [8, 12, 16, 20].map((i) => view.getFloat32(at + i, true));
    const path = { time: [], u: [], lnV: [] };
    let steps = 0;
    for (at += 24; path.time.length < size; at += 3) {
      steps += view.getUint8(at);
      path.time.push((steps / playData.steps) * plane.time);
      path.u.push(uLeast + (view.getUint8(at + 1) / playData.levels) * (uMost - uLeast));
      path.lnV.push(lnVLeast + (view.getUint8(at + 2) / playData.levels) * (lnVMost - lnVLeast));
    }
    found.set(number, path);
  }
  return found;
}

function drawn(name, attributes, text = "") {
  const element = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  element.textContent = text;
  return element;
}

function signed(number, digits) {
  return String(Number(number.toPrecision(digits))).replace("-", "−");
}

// Round numbers from low to high, about as many as wanted.
function roundNumbers(low, high, wanted) {
  const raw = (high - low) / wanted;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = power * [1, 2, 5, 10].find((factor) => factor * power >= raw);
  const first = Math.ceil(low / step - 1e-9);
  const count = Math.floor(high / step + 1e-9) - first + 1;
  return Array.from({ length: Math.max(0, count) }, (_, i) => (first + i) * step);
}

function linearTicks(low, high, wanted) {
  return roundNumbers(low, high, wanted).map((value) => ({ at: value, label: signed(value, 6) }));
}

// 100 is 100, 1000 is ten to the third.
function powerOfTen(power) {
  if (Math.abs(power) < 3) return signed(10 ** power, 1);
  return `10${[...String(power)].map((sign) => "⁻⁰¹²³⁴⁵⁶⁷⁸⁹"["-0123456789".indexOf(sign)]).join("")}`;
}

// Ticks of v on an axis of ln v: powers of ten over many decades, over few 1, 2, 5 times these, over
// less than one round numbers.
function ticksOfV(low, high) {
  const [least, most] = [low, high].map((lnV) => lnV / Math.LN10);
  const powers = roundNumbers(least, most, Math.min(6, most - least)).filter(Number.isInteger);
  if (most - least > 3) return powers.map((power) => ({ at: power * Math.LN10, label: powerOfTen(power) }));
  const parts = most - least > 1.5 ? [1, 3] : [1, 2, 5];
  const decades = Array.from({ length: 5 }, (_, i) => Math.floor(least) + i);
  const multiples = decades.flatMap((decade) => parts.map((part) => part * 10 ** decade));
  const inside = multiples.filter((value) => low <= Math.log(value) && Math.log(value) <= high);
  const values = inside.length >= 3 ? inside : roundNumbers(Math.exp(low), Math.exp(high), 8);
  return values.map((value) => ({ at: Math.log(value), label: signed(value, 6) }));
}

// An empty plot with its axes; what it returns turns values into places.
function plotIn(svg, x, y) {
  const { width, height } = svg.getBoundingClientRect();
  const [left, right, top, bottom] = [52, width - 8, 8, height - 40];
  const scale = (axis, from, to) => (value) => from + ((value - axis.low) / (axis.high - axis.low)) * (to - from);
  const place = { x: scale(x, left, right), y: scale(y, bottom, top), left, right, top, bottom };
  svg.replaceChildren();
  for (const { at, label } of x.ticks) {
    svg.append(
      drawn("line", { class: "tick", x1: place.x(at), x2: place.x(at), y1: top, y2: bottom }),
      drawn("text", { x: place.x(at), y: bottom + 16, "text-anchor": "middle" }, label),
    );
  }
  for (const { at, label } of y.ticks) {
    svg.append(
      drawn("line", { class: "tick", x1: left, x2: right, y1: place.y(at), y2: place.y(at) }),
      drawn("text", { x: left - 5, y: place.y(at) + 4, "text-anchor": "end" }, label),
    );
  }
  const middle = (top + bottom) / 2;
  svg.append(
    drawn("rect", { class: "frame-line", x: left, y: top, width: right - left, height: bottom - top }),
    drawn("text", { x: (left + right) / 2, y: height - 6, "text-anchor": "middle" }, x.title),
    drawn("text", { x: 12, y: middle, "text-anchor": "middle", transform: `rotate(-90 12 ${middle})` }, y.title),
  );
  return place;
}

// The range of some values with a margin; at rest they are all the same.
function rangeOf(values, least) {
  const [low, high] = values.length ? [Math.min(...values), Math.max(...values)] : [0, 0];
  const margin = Math.max(0.06 * (high - low), high > low ? 0 : least);
  return { low: low - margin, high: high + margin };
}

// The path of a cycle is one period; over time it repeats.
function repeated(path, time) {
  const period = path.time.at(-1);
  // the period is rounded to a step of time
  const turns = Array.from({ length: Math.ceil(time / period - 0.01) }, (_, i) => i);
  const again = (values, shift) => turns.flatMap((turn) => values.map((value) => value + turn * shift));
  return { time: again(path.time, period), lnV: again(path.lnV, 0) };
}

function drawMotion(view, plane, path, isCycle) {
  const v = { title: "velocity v (units of v₀)", ...rangeOf(path.lnV, 0.5) };
  v.ticks = ticksOfV(v.low, v.high);
  const time = { title: "time t (units of L/v₀)", low: 0, high: plane.time || 1 };
  time.ticks = linearTicks(time.low, time.high, 6);
  const u = { title: "displacement u (units of L)", ...rangeOf(path.u, 1) };
  u.ticks = linearTicks(u.low, u.high, 4);
  const overTime = isCycle && path.time.length ? repeated(path, plane.time) : path;
  drawCurve(view.querySelector(".play-time"), time, v, overTime.time, overTime.lnV);
  drawCurve(view.querySelector(".play-portrait"), u, v, path.u, path.lnV);
}

// A curve in a plot, as far as it is inside; a single place is a dot.
function drawCurve(svg, x, y, across, up) {
  const place = plotIn(svg, x, y);
  if (!across.length) return;
  const { left, right, top, bottom } = place;
  const id = `inside-${svg.classList[0]}`;
  const inside = drawn("clipPath", { id });
  inside.append(drawn("rect", { x: left, y: top, width: right - left, height: bottom - top }));
  const points = across.map((value, i) => [place.x(value).toFixed(1), place.y(up[i]).toFixed(1)]);
  svg.append(inside, drawn("polyline", { class: "motion", "clip-path": `url(#${id})`, points: points.join(" ") }));
  const isDot = across.every((value, i) => value === across[0] && up[i] === up[0]);
  if (isDot) svg.append(drawn("circle", { class: "motion", cx: points[0][0], cy: points[0][1], r: 3 }));
}

// Classes as a picture with one pixel a point.
function pictureOf(plane, colours) {
  const canvas = document.createElement("canvas");
  const [columns, lines] = [plane.epsilon.length, plane.tau.length];
  [canvas.width, canvas.height] = [columns, lines];
  const brush = canvas.getContext("2d");
  [...plane.kinds].forEach((kind, i) => {
    brush.fillStyle = colours[kind];
    brush.fillRect(i % columns, lines - 1 - Math.floor(i / columns), 1, 1);
  });
  return canvas.toDataURL();
}

// An axis of cells, half a cell wider than their middles on both sides.
function axisOfCells(values, title, wanted) {
  const half = values.length > 1 ? (values.at(-1) - values[0]) / (values.length - 1) / 2 : 0.5;
  const [low, high] = [values[0] - half, values.at(-1) + half];
  return { title, low, high, ticks: linearTicks(low, high, wanted) };
}

function nearest(values, wanted) {
  const distances = values.map((value) => Math.abs(value - wanted));
  return distances.indexOf(Math.min(...distances));
}

function playView(view) {
  const [select, epsilon, tau] = ["select", "#play-epsilon", "#play-tau"].map((one) => view.querySelector(one));
  const map = view.querySelector(".play-map");
  const colours = [...view.querySelectorAll(".legend rect")].map((rect) => rect.getAttribute("fill"));
  const kinds = [...view.querySelectorAll(".legend li")].map((item) => item.dataset.kind);
  const [known, pictures] = [new Map(), new Map()];
  let [mapped, place] = [null, null];

  const planeNow = () => playData.planes[select.value];
  const once = (kept, plane, make) => {
    if (!kept.has(plane)) kept.set(plane, make(plane));
    return kept.get(plane);
  };

  const kindOf = (plane, number) => kinds[plane.kinds[number]];

  // Steady sliding has no path of its own; of another motion without a path nothing is known.
  function restOf(plane, number) {
    const isRest = kindOf(plane, number) === "fixed point";
    return isRest ? { time: [0, plane.time || 1], u: [0, 0], lnV: [0, 0] } : { time: [], u: [], lnV: [] };
  }

  function drawMap(plane) {
    const x = axisOfCells(plane.epsilon, "sensitivity ε", 6);
    const y = axisOfCells(plane.tau, "delay τ (units of L/v₀)", 5);
    const place = plotIn(map, x, y);
    const area = { x: place.left, y: place.top, width: place.right - place.left, height: place.bottom - place.top };
    const href = once(pictures, plane, () => pictureOf(plane, colours));
    map.append(drawn("image", { ...area, href, preserveAspectRatio: "none" }));
    const middle = { cx: place.x(plane.epsilon[epsilon.value]), cy: place.y(plane.tau[tau.value]), r: 7 };
    map.append(drawn("circle", { class: "mark-edge", ...middle }), drawn("circle", { class: "mark", ...middle }));
    mapped = { area, columns: plane.epsilon.length, lines: plane.tau.length };
  }

  function say(plane, number, shown) {
    const columns = plane.epsilon.length;
    const at = (i) => `ε = ${signed(plane.epsilon[i % columns], 4)}, τ = ${signed(plane.tau[Math.floor(i / columns)], 4)}`;
    const [motion, exponents, frequencies] = plane.words[shown];
    view.querySelector(".play-class").textContent = `${at(number)}: ${motion}`;
    const more = [
      number !== shown && `This point was not computed: its neighbours are of one class. Shown is the nearest computed point of this class, ${at(shown)}`,
      exponents && `Lyapunov exponents ${exponents} (units of v₀/L)`,
      frequencies && `${frequencies[0].toUpperCase()}${frequencies.slice(1)}`,
    ];
    view.querySelector(".play-more").textContent = more.filter(Boolean).map((sentence) => `${sentence}.`).join(" ");
  }

  function show() {
    const plane = planeNow();
    const number = Number(epsilon.value) + plane.epsilon.length * Number(tau.value);
    const shown = plane.shown[number];
    for (const [slider, values, sign] of [[epsilon, plane.epsilon, "ε"], [tau, plane.tau, "τ"]]) {
      const value = signed(values[slider.value], 4);
      slider.nextElementSibling.textContent = value;
      slider.setAttribute("aria-valuetext", `${sign} = ${value}`);
    }
    place = { epsilon: plane.epsilon[epsilon.value], tau: plane.tau[tau.value] };
    const isCycle = kindOf(plane, shown).endsWith("cycle");
    drawMotion(view, plane, once(known, plane, pathsOf).get(shown) || restOf(plane, shown), isCycle);
    drawMap(plane);
    say(plane, number, shown);
  }

  function goTo(wanted) {
    const plane = planeNow();
    epsilon.max = plane.epsilon.length - 1;
    tau.max = plane.tau.length - 1;
    epsilon.value = nearest(plane.epsilon, wanted.epsilon);
    tau.value = nearest(plane.tau, wanted.tau);
    show();
  }

  function take(event) {
    const box = map.getBoundingClientRect();
    const share = (at, from, length) => Math.max(0, Math.min(1 - 1e-9, (at - from) / length));
    const { area, columns, lines } = mapped;
    epsilon.value = Math.floor(share(event.clientX - box.left, area.x, area.width) * columns);
    tau.value = lines - 1 - Math.floor(share(event.clientY - box.top, area.y, area.height) * lines);
    show();
  }

  playData.planes.forEach((plane, i) => {
    select.append(new Option(`ξ = ${signed(plane.xi, 6)}, γ = ${plane.gamma < 1e4 ? signed(plane.gamma, 6) : plane.gamma.toExponential().replace("e+", "e")}${plane.law && `, law ${plane.law.replaceAll("_", " ")}`}`, i));
  });
  view.querySelector(".play-scenes").hidden = playData.scenes.length === 0;
  for (const scene of playData.scenes) {
    const button = document.createElement("button");
    button.type = "button";
    button.textContent = scene.name;
    button.addEventListener("click", () => {
      select.value = scene.plane;
      goTo(scene);
    });
    view.querySelector(".play-scenes").append(button);
  }
  select.addEventListener("change", () => goTo(place));
  for (const slider of [epsilon, tau]) slider.addEventListener("input", show);
  map.addEventListener("pointerdown", take);
  map.addEventListener("pointermove", (event) => event.buttons && take(event));
  const numberOf = (plane, wanted) => nearest(plane.epsilon, wanted.epsilon) + plane.epsilon.length * nearest(plane.tau, wanted.tau);
  const moves = (scene) => {
    const plane = playData.planes[scene.plane];
    return kindOf(plane, numberOf(plane, scene)) !== "fixed point";
  };
  const first = playData.scenes.find(moves) || playData.scenes[0] || { plane: 0, epsilon: 0, tau: 0 };
  select.value = first.plane;
  goTo(first);
  // on paper the view is hidden and has no size
  new ResizeObserver(() => view.clientWidth && show()).observe(view);
}

playView(document.getElementById("play-view"));
