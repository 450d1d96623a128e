"use strict";
// The view of trajectories to zoom into, drawn by dygraphs.

function numbers(text) {
  const bytes = Uint8Array.from(atob(text), (sign) => sign.charCodeAt(0));
  const view = new DataView(bytes.buffer);
  return Array.from({ length: bytes.length / 4 }, (_, i) => view.getFloat32(4 * i, true));
}

function rowsOf(run) {
  const [first, ...others] = run.series.map((one) => numbers(one.values));
  const times = run.times ? numbers(run.times) : first.map((_, i) => i * run.step);
  return first.map((value, i) => [run.start + times[i], value, ...others.map((other) => other[i])]);
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
    xlabel: "time t (units of L/v₀)",
    series: { u: { axis: "y2" } },
    axes: { y2: { independentTicks: true, drawGrid: false } },
    digitsAfterDecimal: 4,
    strokeWidth: 1,
    axisLabelFontSize: 13,
  });
  function show(run) {
    const titles = run.series.map((one) => ({ v: "velocity v (units of v₀)", u: "displacement u (units of L)" })[one.name]);
    const axes = { ylabel: titles[0], y2label: titles[1] || "" };
    graph.updateOptions({ file: rowsOf(run), labels: labelsOf(run), dateWindow: null, valueRange: null, ...axes });
    const thinned = run.every > 1 ? ` One sample in ${run.every} is drawn.` : "";
    read.textContent = `${run.words}.${thinned}`;
  }
  view.querySelector("select").addEventListener("change", (event) => show(runs[event.target.value]));
  view.querySelector("button").addEventListener("click", () => graph.resetZoom());
  view.querySelector("select").value = "0";
  show(runs[0]);
}

document.documentElement.classList.add("scripted");
const trajectories = document.getElementById("trajectories");
if (trajectories) {
  trajectoryView(document.getElementById("trajectory-view"), JSON.parse(trajectories.textContent));
}
