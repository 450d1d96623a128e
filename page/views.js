"use strict";
// The two views of the page: trajectories to zoom into, drawn by dygraphs, and the atlas by cells.

function numbers(text) {
  const bytes = Uint8Array.from(atob(text), (sign) => sign.charCodeAt(0));
  const view = new DataView(bytes.buffer);
  return Array.from({ length: bytes.length / 4 }, (_, i) => view.getFloat32(4 * i, true));
}

function rowsOf(run) {
  const [first, ...others] = run.series.map((one) => numbers(one.values));
  return first.map((value, i) => [run.start + i * run.step, value, ...others.map((other) => other[i])]);
}

function labelsOf(run) {
  return ["t", ...run.series.map((one) => one.name)];
}

function legendOf(legend) {
  const lines = legend.series.map((line) => `${line.dashHTML} ${line.labelHTML}${line.yHTML ? ` = ${line.yHTML}` : ""}`);
  return [legend.xHTML ? `t = ${legend.xHTML}` : "", ...lines].join(" &nbsp; ");
}

function trajectoryView(view, runs) {
  const plot = view.querySelector(".plot");
  const read = view.querySelector(".read");
  const graph = new Dygraph(plot, rowsOf(runs[0]), {
    labels: labelsOf(runs[0]),
    colors: ["#0072B2", "#D55E00"],
    labelsDiv: view.querySelector(".values"),
    legend: "always",
    legendFormatter: legendOf,
    xlabel: "time t",
    digitsAfterDecimal: 4,
    strokeWidth: 1,
    axisLabelFontSize: 13,
  });
  function show(run) {
    graph.updateOptions({ file: rowsOf(run), labels: labelsOf(run), dateWindow: null, valueRange: null });
    const thinned = run.every > 1 ? ` One sample in ${run.every} is drawn.` : "";
    read.textContent = `${run.words}.${thinned}`;
  }
  view.querySelector("select").addEventListener("change", (event) => show(runs[event.target.value]));
  view.querySelector("button").addEventListener("click", () => graph.resetZoom());
  view.querySelector("select").value = "0";
  show(runs[0]);
}

function atlasView(view) {
  const read = view.querySelector(".read");
  let chosen = null;

  function choose(cell) {
    if (chosen) chosen.classList.remove("chosen");
    chosen = cell;
    cell.classList.add("chosen");
    cell.parentNode.append(cell); // above its neighbours
    read.textContent = cell.dataset.words;
  }

  function place(cell) {
    return { x: Number(cell.getAttribute("x")), y: Number(cell.getAttribute("y")) };
  }

  function move(map, right, down) {
    const from = chosen && chosen.parentNode === map ? place(chosen) : null;
    const wanted = from ? { x: from.x + right, y: from.y + down } : { x: 0, y: 0 };
    const next = map.querySelector(`[x="${wanted.x}"][y="${wanted.y}"]`);
    if (next) choose(next);
  }

  function zoom(factor) {
    const map = chosen ? chosen.parentNode : view.querySelector(".map svg");
    const whole = map.dataset.whole || map.getAttribute("viewBox");
    map.dataset.whole = whole;
    const [, , width, height] = whole.split(" ").map(Number);
    const share = Math.min(1, map.viewBox.baseVal.width / width / factor);
    const centre = chosen ? place(chosen) : { x: width / 2, y: height / 2 };
    const w = share * width;
    const h = share * height;
    const x = Math.max(0, Math.min(width - w, centre.x + 0.5 - w / 2));
    const y = Math.max(0, Math.min(height - h, centre.y + 0.5 - h / 2));
    map.setAttribute("viewBox", `${x} ${y} ${w} ${h}`);
  }

  const steps = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
  for (const map of view.querySelectorAll(".map svg")) {
    for (const event of ["pointermove", "click"]) {
      map.addEventListener(event, ({ target }) => {
        if (target.dataset.words && target !== chosen) choose(target);
      });
    }
    map.addEventListener("keydown", (event) => {
      if (!steps[event.key]) return;
      event.preventDefault();
      move(map, ...steps[event.key]);
    });
  }
  for (const button of view.querySelectorAll("[data-zoom]")) {
    button.addEventListener("click", () => zoom(button.dataset.zoom === "in" ? 1.5 : 1 / 1.5));
  }
}

document.documentElement.classList.add("scripted");
const trajectories = document.getElementById("trajectories");
if (trajectories) {
  trajectoryView(document.getElementById("trajectory-view"), JSON.parse(trajectories.textContent));
}
const atlas = document.getElementById("atlas-view");
if (atlas) atlasView(atlas);
