// Ranks designs as sweep/ranking/rank.py does: the same sums in the same order, so the same ties.

const ROUND_OFF = 1e-9;

// Work (J) done until the force first exceeds a limit (N), from stairs [forces, works].
function workUntil(limit, [forces, works]) {
  const k = forces.findIndex((force) => force > limit);
  if (k < 0) return works[works.length - 1];
  if (k === 0) return works[0];
  const share = (limit - forces[k - 1]) / (forces[k] - forces[k - 1]);
  return works[k - 1] + share * (works[k] - works[k - 1]);
}

// Number of the energy whose force is that of the question; -1 if it must be read from curves.
function storedEnergy(data, question) {
  return data.energies.findIndex((energy) => energy.force === question.force);
}

function countedEnergy(data, design, question) {
  const known = storedEnergy(data, question);
  if (known >= 0) return design.energies[known];
  return design.stairs ? [workUntil(question.force, design.stairs), null, null] : [null, null, null];
}

const BESIDE = 0.4e-3; // m, between two specimens

// Numbers of specimens of an outer width x depth (m) side by side and one behind the other, of the
// panel nearest to two lengths (m), at least one each, and its true lengths: sweep/design/panel.py.
function panelOf([first, second], [width, depth]) {
  const across = Math.max(1, Math.floor((first + BESIDE) / (width + BESIDE) + 0.5));
  const behind = Math.max(1, Math.floor(second / depth + 0.5));
  return { specimens: across * behind, lengths: [across * (width + BESIDE) - BESIDE, behind * depth] };
}

// What is compared of one design. question: scene, budget (g) or null, panel [m, m] or null,
// force (N) or null.
function measured(data, design, question) {
  const scene = data.scenes[question.scene];
  const [energy, error, correction] = countedEnergy(data, design, question);
  const panel = question.panel ? panelOf(question.panel, design.outer) : null;
  const factor = panel ? panel.specimens : 1;
  const times = (value, by) => (value === null ? null : by * value);
  const row = {
    design,
    panel,
    mass: factor * design.mass,
    energy: times(energy, factor),
    perGram: energy === null ? null : energy / design.mass,
    passed: question.force === null ? design.passed : Math.min(design.peak, question.force),
    beyond: design.solid || (energy !== null && energy > design.within * (1 + ROUND_OFF)),
  };
  row.early =
    scene.mode === "displacement" && question.force !== null && design.peak <= row.passed;
  let bars;
  if (scene.least) bars = design.least;
  else if (question.panel || question.budget !== null)
    bars = [row.energy, times(error, factor), times(correction, factor)];
  else
    bars = [row.perGram, ...[error, correction].map((v) => (v === null ? null : v / design.mass))];
  [row.value, row.error, row.correction] = bars;
  return row;
}

// Marks rows such that none lighter is as good and none as light is better.
function markFront(rows, merit) {
  const best = new Map();
  const key = (row) => Math.round(row.mass * 1e9);
  for (const row of rows) {
    const value = merit(row);
    if (value !== null && value > (best.get(key(row)) ?? -Infinity)) best.set(key(row), value);
  }
  let lighter = -Infinity;
  const least = new Map();
  for (const mass of [...best.keys()].sort((a, b) => a - b)) {
    least.set(mass, lighter);
    lighter = Math.max(lighter, best.get(mass));
  }
  for (const row of rows)
    row.pareto = merit(row) === best.get(key(row)) && merit(row) > least.get(key(row));
}

// Places of sorted rows: a value shares the place of the first value of that place if it differs
// from it by no more than their corrections differ, or, without corrections, their errors add up to.
function markPlaces(rows, bar) {
  let best = NaN;
  let first = NaN;
  rows.forEach((row, i) => {
    const width = bar ? (row[bar] ?? 0) : 0;
    const slack = bar === "correction" ? Math.abs(width - first) : width + first;
    if (Math.abs(row.value - best) <= slack) row.place = rows[i - 1].place;
    else [best, first, row.place] = [row.value, width, i + 1];
  });
  const sharing = new Map();
  for (const row of rows) sharing.set(row.place, (sharing.get(row.place) ?? 0) + 1);
  for (const row of rows) row.sharing = sharing.get(row.place);
}

// All designs of a scene as `rows`, and those with a place, best first, as `placed`.
function ranked(data, question) {
  const scene = data.scenes[question.scene];
  const designs = data.cases.filter((design) => design.scene === question.scene);
  const rows = designs.map((design) => measured(data, design, question));
  const sign = scene.least ? 1 : -1;
  markFront(rows, scene.least ? (row) => (row.value === null ? null : -row.value) : (row) => row.energy);
  const most = question.budget === null ? Infinity : question.budget * (1 + ROUND_OFF);
  const placed = rows.filter((row) => row.mass <= most && row.value !== null);
  const byId = (a, b) => (a.design.id < b.design.id ? -1 : 1);
  placed.sort((a, b) => sign * (a.value - b.value) || a.mass - b.mass || byId(a, b));
  const known = storedEnergy(data, question);
  const bar = scene.least ? scene.bar : known >= 0 ? data.energies[known].bar : null;
  markPlaces(placed, bar);
  return { rows, placed, bar, lightest: Math.min(...rows.map((row) => row.mass)) };
}
