// What is on the page: colors, histograms, the table, the worst triangles.
const data = JSON.parse(document.getElementById("data").textContent);
const report = data.report;
const element = id => document.getElementById(id);
const short = x => Number.isFinite(x) ? String(+x.toPrecision(4)) : "–";

function decoded(text, Type) {
  return new Type(Uint8Array.from(atob(text), c => c.charCodeAt(0)).buffer);
}

/// A mesh's arrays with the shape of each triangle. Lengths are in the input's unit.
function measured(mesh) {
  const points = decoded(mesh.points, Float32Array), faces = decoded(mesh.faces, Int32Array);
  const n = faces.length / 3;
  const m = {points, faces, distance: decoded(mesh.distance, Float32Array),
             density: decoded(mesh.density, Float32Array), corners: new Float32Array(9 * n),
             quality: new Float32Array(n), area: new Float32Array(n),
             angles: new Float32Array(3 * n), edges: new Float32Array(3 * n)};
  for (let f = 0; f < n; ++f) {
    const p = cornersOf(m, f), l = [];
    for (let k = 0; k < 3; ++k) {
      m.corners.set(p[k], 9 * f + 3 * k);
      l[k] = data.unit * Math.hypot(...p[k].map((x, i) => x - p[(k + 1) % 3][i]));
      m.edges[3 * f + k] = l[k];
    }
    const u = p[1].map((x, i) => x - p[0][i]), v = p[2].map((x, i) => x - p[0][i]);
    const twice = data.unit ** 2 * length(cross(u, v));
    m.area[f] = twice / 2;
    m.quality[f] = twice > 0
        ? Math.sqrt(3) * twice / ((l[0] + l[1] + l[2]) / 2 * Math.max(...l)) : 0;
    for (let k = 0; k < 3; ++k) {
      const a = l[k], b = l[(k + 2) % 3], c = l[(k + 1) % 3];
      m.angles[3 * f + k] = Math.atan2(twice, (a * a + b * b - c * c) / 2) * 180 / Math.PI;
    }
  }
  return m;
}

/// The cells as triangles around their middles, with how many sides each one's cell has.
function fanned({points, sides}) {
  const p = decoded(points, Float32Array), corners = new Float32Array(3 * p.length);
  const counts = new Int32Array(p.length / 3);
  let first = 0;
  for (const n of decoded(sides, Int32Array)) {
    const polygon = Array.from({length: n}, (_, k) => p.slice(3 * (first + k), 3 * (first + k) + 3));
    const middle = [0, 1, 2].map(i => polygon.reduce((sum, q) => sum + q[i], 0) / n);
    for (let k = 0; k < n; ++k)
      corners.set([...middle, ...polygon[k], ...polygon[(k + 1) % n]], 9 * (first + k));
    counts.fill(n, first, first += n);
  }
  return {corners, counts};
}

function cornersOf(m, f) {
  return [0, 1, 2].map(k => [0, 1, 2].map(i => m.points[3 * m.faces[3 * f + k] + i]));
}

// ---- colors: viridis
const STOPS = [[68, 1, 84], [65, 68, 135], [42, 120, 142], [34, 168, 132], [122, 209, 81],
               [253, 231, 37]];
function viridis(t) {
  const x = 5 * Math.min(1, Math.max(0, t || 0)), k = Math.min(4, Math.floor(x)), s = x - k;
  return STOPS[k].map((a, i) => a + s * (STOPS[k + 1][i] - a));
}

/// Of cells: blue, less than six sides; red, more.
const SIDES = [[69, 117, 180], [145, 191, 219], [236, 236, 224], [252, 141, 89], [215, 48, 39]];
const GRAY = [187, 187, 187];
function ofSides(n) {
  return SIDES[Math.min(8, Math.max(4, n)) - 4];
}

/// The share-th smallest.
function quantile(values, share) {
  const sorted = Float32Array.from(values).sort();
  return sorted[Math.min(sorted.length - 1, Math.floor(share * sorted.length))];
}

/// What a choice of colors that are no cells' shows: values of triangles or of vertices, the range, and
/// whether logarithms.
function shownBy(choice) {
  const values = meshes.map(m => m[choice]);
  if (choice === "quality") return {values, ofVertices: false, range: [0, 1], log: false};
  if (choice === "area") {
    const range = [quantile(values[1], .001) / 1.5, quantile(values[1], .999) * 1.5];
    return {values, ofVertices: false, range, log: true};
  }
  const all = values.map(v => [quantile(v, 0), quantile(v, choice === "distance" ? .9999 : 1)]);
  const range = [Math.min(all[0][0], all[1][0]), Math.max(all[0][1], all[1][1])];
  if (choice === "distance") range[0] = 0;
  return {values, ofVertices: true, range, log: choice === "density"};
}

/// Bytes for all corners; `color(c)`: that of a corner.
function colored({corners}, color) {
  const bytes = new Uint8Array(4 * corners.length / 3);
  for (let c = 0; 4 * c < bytes.length; ++c) bytes.set(color(c), 4 * c);
  return bytes;
}

function paint(choice) {
  const isOfCells = choice === "cells";
  let ends = ["≤ 4", "≥ 8"], colors = [() => GRAY, () => GRAY];
  if (!isOfCells) {
    const {values, ofVertices, range, log} = shownBy(choice);
    const at = log ? Math.log : x => x, lo = at(range[0]), width = at(range[1]) - lo || 1;
    ends = range.map(short);
    colors = meshes.map(({faces}, k) => c =>
      viridis((at(values[k][ofVertices ? faces[c] : Math.floor(c / 3)]) - lo) / width));
  }
  element("least").textContent = ends[0];
  element("most").textContent = ends[1];
  element("right").textContent = isOfCells ? "cells of the samples" : "output";
  paintLegend(isOfCells ? t => ofSides(4 + Math.floor(4.99 * t)) : viridis);
  if (!view) return;
  view.right = isOfCells ? 2 : 1;
  meshes.forEach((m, k) => view.setColors(k, colored(m, colors[k])));
}

function paintLegend(color) {
  const context = element("legend").getContext("2d");
  for (let x = 0; x < 256; ++x) {
    context.fillStyle = `rgb(${color(x / 255).map(Math.round)})`;
    context.fillRect(x, 0, 1, 1);
  }
}

// ---- histograms
const BINS = 45;
function shares(values, [lo, hi]) {
  const counts = new Array(BINS).fill(0);
  for (const x of values)
    ++counts[Math.min(BINS - 1, Math.max(0, Math.floor((x - lo) / (hi - lo) * BINS)))];
  return counts.map(c => c / (values.length || 1));
}

function chart(title, both, range) {
  const width = 320, height = 130, left = 8, base = height - 18;
  const bars = both.map(values => shares(values, range));
  const most = Math.max(...bars.flat()) || 1;
  const x = k => left + k * (width - 2 * left) / BINS, y = s => base - s / most * (base - 6);
  const input = bars[0].map((s, k) =>
    `<rect x="${x(k)}" y="${y(s)}" width="${x(1) - x(0)}" height="${base - y(s)}" fill="#bbb"/>`);
  const line = bars[1].map((s, k) => `${x(k)},${y(s)} ${x(k + 1)},${y(s)}`).join(" ");
  const ticks = [0, .25, .5, .75, 1].map(t =>
    `<text x="${left + t * (width - 2 * left)}" y="${height - 4}" text-anchor="${
      t === 0 ? "start" : t === 1 ? "end" : "middle"}">${
      short(range[0] + t * (range[1] - range[0]))}</text>`);
  return `<figure><figcaption>${title}</figcaption><svg viewBox="0 0 ${width} ${height}" role="img"
    aria-label="histogram: ${title}">${input.join("")}<polygon points="${left},${base} ${line} ${
    width - left},${base}" fill="#2a6f97" fill-opacity=".35" stroke="#2a6f97"/>
    <path d="M${left} ${base}H${width - left}" stroke="#555"/>${ticks.join("")}</svg></figure>`;
}

function drawCharts() {
  const of = name => meshes.map(m => m[name]);
  const upTo = (name, share) => [0, Math.max(...of(name).map(v => quantile(v, share))) || 1];
  element("charts").innerHTML = chart("angles (degrees)", of("angles"), [0, 180]) +
    chart("quality", of("quality"), [0, 1]) +
    chart("lengths of edges", of("edges"), upTo("edges", .995)) +
    chart("distance of vertices to the other", of("distance"), upTo("distance", 1));
}

// ---- words
function drawTable() {
  const [input, output] = meshes;
  const least = values => values.reduce((a, b) => Math.min(a, b), Infinity);
  const most = values => values.reduce((a, b) => Math.max(a, b), 0);
  const mean = values => values.reduce((a, b) => a + b, 0) / values.length;
  const rows = [
    ["vertices", report.input_vertices, report.vertices],
    ["triangles", report.input_faces, report.faces],
    ["components", report.input_components, report.components],
    ["Euler characteristic", report.input_euler_characteristic, report.euler_characteristic],
    ["border loops", report.input_border_loops, report.border_loops],
    ["self-intersections", "", report.self_intersections],
    ["quality, least", least(input.quality), report.q_min],
    ["quality, mean", mean(input.quality), report.q_avg],
    ["angle, least", least(input.angles), report.theta_min],
    ["angle, largest", most(input.angles), report.theta_max],
    ...(report.thin_parts.places ? [
      ["places too thin for the spacing", "", report.thin_parts.places],
      ["samples that do with --thin refine", "", report.thin_parts.samples]] : []),
    ["length of edges, least", least(input.edges), report.edge_length_min],
    ["length of edges, mean", mean(input.edges), report.edge_length_mean],
    ["length of edges, largest", most(input.edges), report.edge_length_max],
    ["distance, RMS (% of the diagonal)", "", report.distance_rms],
    ["distance, largest (% of the diagonal)", "", report.distance_max],
    ["distance, largest", "", report.absolute_distance_max],
    ["edges of creases and borders", report.crease_edges + report.input_border_edges,
     report.feature_edges],
    ["preset; seed", "", `${report.preset}; ${report.seed}`]];
  const table = element("table");
  for (const cells of [["", "input", "output"], ...rows]) {
    const row = table.insertRow();
    row.appendChild(document.createElement("th")).textContent = cells[0];
    for (const value of cells.slice(1))
      row.insertCell().textContent = typeof value === "number" ? short(value) : value;
  }
  element("report").textContent = JSON.stringify(report, null, 2);
  element("summary").textContent = `${report.input || ""} · ${report.program.split(" ").pop()}`;
  const missed = report.missed_guarantees;
  element("missed").textContent = missed.length ? "Missed: " + missed.join("; ")
                                                : "Every guarantee is met.";
  element("missed").className = missed.length ? "failed" : "";
}

function listWorst() {
  const m = meshes[1], list = element("worst");
  const order = Array.from(m.quality.keys()).sort((a, b) => m.quality[a] - m.quality[b]);
  for (const f of order.slice(0, 15)) {
    const button = document.createElement("button");
    const angles = Array.from(m.angles.slice(3 * f, 3 * f + 3)).sort((a, b) => a - b);
    button.textContent = `Q ${m.quality[f].toFixed(3)} · ${
      angles.map(a => a.toFixed(0) + "°").join(" ")} · triangle ${f}`;
    button.onclick = () => {
      list.querySelectorAll(".chosen").forEach(b => b.classList.remove("chosen"));
      button.classList.add("chosen");
      if (view) view.show(f, cornersOf(m, f));
    };
    list.appendChild(document.createElement("li")).appendChild(button);
  }
}

const meshes = [data.input, data.output].map(measured), cells = fanned(data.cells);
const color = element("color"), wanted = location.hash.slice(1);
let view = null;
try {
  view = new View(element("meshes"), [...meshes, cells]);
  view.setColors(2, colored(cells, c => ofSides(cells.counts[Math.floor(c / 3)])));
} catch (error) {
  element("no-view").hidden = false;
}
if ([...color.options].some(option => option.value === wanted)) color.value = wanted;
paint(color.value);
drawCharts();
drawTable();
listWorst();
color.onchange = () => paint(color.value);
element("lines").onchange = e => {
  if (view) { view.lines = e.target.checked ? 1 : 0; view.draw(); }
};
element("whole").onclick = () => view && view.whole();
