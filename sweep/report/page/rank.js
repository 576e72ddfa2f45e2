// Ranks designs as sweep/ranking/rank.py does: the same sums in the same order, so the same ties.
// Other files of that folder are repeated too: merit.py (measured, incomparable), places.py (markFront,
// markPlaces), unfinished.py (couldPlace) and requirements.py (which limits a scene has, and by how much a design misses them).
// An unknown value is null, which JavaScript takes for 0: `times`, `ratio`, `least` and `exceeds` do not.

const times = (value, by) => (value === null ? null : by * value);
const ratio = (value, by) => (value === null || by === null ? null : value / by);
const least = (value, most) => (value === null ? null : Math.min(value, most));
const exceeds = (value, limit) => value !== null && limit !== null && value > limit;

// The greatest mass (g) within the budget of a question.
function greatestMass(data, question) {
  return question.budget === null ? Infinity : question.budget * (1 + data.round_off);
}

// The value at which the force first exceeds a limit (N), linear in a power of the force between two
// points: a stroke in the force itself, the work (J), from stairs, in its square.
function valueUntil(limit, forces, values, power) {
  const k = forces.findIndex((force) => force > limit);
  if (k < 0) return values[values.length - 1];
  if (k === 0) return values[0];
  const [low, high] = [forces[k - 1] ** power, forces[k] ** power];
  return values[k - 1] + ((limit ** power - low) / (high - low)) * (values[k] - values[k - 1]);
}

// Whether the force and what is required are of the panel.
function ofPanel(question) {
  return question.per === "panel" && Boolean(question.panel);
}

// Number of the energy whose force is that of the question; -1 if it must be read from curves, as
// the force of a specimen must which has its share of that of a panel.
function storedEnergy(data, question) {
  if (question.force !== null && ofPanel(question)) return -1;
  const name = (force) => (force === null ? null : Number(force.toPrecision(10))); // of its column
  return data.energies.findIndex((energy) => energy.force === name(question.force));
}

// Energy (J) until a specimen bears a force (N), its error and its correction, and the stroke (m) in
// which it is absorbed; read from the stairs where they are not stored.
function countedUntil(data, design, question, force) {
  const known = storedEnergy(data, question);
  if (known >= 0) return [...design.energies[known], design.strokes[known] ?? null];
  if (!design.stairs) return [null, null, null, null];
  const [forces, works, strokes] = design.stairs;
  return [valueUntil(force, forces, works, 2), null, null, valueUntil(force, forces, strokes, 1)];
}

// The limits (SI) that are asked of the designs of a scene: sweep/ranking/requirements.py. Those of
// a panel need a panel.
function askedOf(data, question) {
  if (question.per === "panel" && !question.panel) return {};
  const { requires } = data.scenes[question.scene];
  return Object.fromEntries(Object.entries(question.require).filter(([name]) => requires.includes(name)));
}

// Whether forces, energies or masses of periods of unequal area would be compared: merit.py.
function incomparable(data, question) {
  if (!data.scenes[question.scene].unequal || ofPanel(question)) return false;
  const shared = Object.keys(askedOf(data, question)).some((name) => data.measures[name].shared);
  return shared || question.force !== null;
}

// Whether a panel is smaller than half of some specimen: panel_in of merit.py.
function isTooSmall(data, { panel }) {
  const fits = (side, one, gap) => side + gap >= (one + gap) / 2;
  const holds = ({ outer, gap }) => fits(panel[0], outer[0], data.beside) && fits(panel[1], outer[1], gap);
  return Boolean(panel) && !data.largest.every(holds);
}

// The value (SI) of a row for each requirement, of a specimen or of the panel.
function required(data, row, question) {
  const { design } = row;
  const crushed = data.scenes[question.scene].driven;
  const count = row.panel ? row.panel.specimens : 1;
  const of = {
    max_force: crushed ? row.passed : design.peak,
    max_deceleration: design.deceleration,
    max_base_pressure: design.pressure,
    max_target_acceleration: design.accelerated,
    max_mass: row.mass / data.factors.g / count,
    min_absorbed: row.energy === null ? null : row.energy / count,
    max_stroke: row.stroke,
  };
  const together = ofPanel(question) ? count : 1;
  for (const [name, { shared }] of Object.entries(data.measures))
    if (shared) of[name] = times(of[name], together);
  return of;
}

// By what share of its limit a row misses each requirement: 0 if it is met, Infinity if unknown.
function missesOf(data, row, question) {
  const asked = Object.entries(askedOf(data, question));
  if (!asked.length) return {};
  const found = required(data, row, question);
  const shares = asked.map(([name, limit]) => {
    const value = found[name] ?? null;
    if (value === null) return [name, Infinity];
    const share = data.measures[name].least ? 1 - value / limit : value / limit - 1;
    return [name, share <= data.round_off ? 0 : share];
  });
  return Object.fromEntries(shares);
}

// The requirements whose limits a row is nearer to than the error of its value, if it misses no other
// one by more.
function closeOf(data, row, question) {
  const values = required(data, row, question);
  const known = storedEnergy(data, question);
  const errors = row.design.errors.at(known); // the last ones are those at other forces
  const within = ([name, limit]) => {
    const error = (errors[name] ?? 0) * (values[name] ?? 0);
    return Math.abs(values[name] - limit) < error;
  };
  const close = Object.entries(askedOf(data, question)).filter(within).map(([name]) => name);
  const others = Object.keys(row.misses).filter((name) => !close.includes(name));
  return others.every((name) => row.misses[name] === 0) ? close : [];
}

// Whether a row misses its least energy alone, and may absorb it in a longer crush.
function mayFulfil(data, row, question) {
  const limits = askedOf(data, question);
  const { min_absorbed: energy, max_force = Infinity, max_stroke = Infinity } = limits;
  const { min_absorbed: short = 0, ...others } = row.misses;
  const alone = short > 0 && short < Infinity && Object.values(others).every((share) => share === 0);
  if (!row.open || !alone) return false;
  const force = Math.min(max_force, question.force ?? Infinity);
  return force * Math.min(row.design.height, max_stroke) >= energy;
}

// How the designs within the budget meet what is required: the numbers of `Outcome`.
function outcomeOf(data, { rows }, question) {
  const part = rows.filter((row) => row.mass <= greatestMass(data, question));
  const fulfilling = part.filter((row) => row.worst === 0);
  const close = part.filter((row) => !doubtful(row)).flatMap((row) => closeOf(data, row, question));
  const names = Object.keys(askedOf(data, question));
  const each = (count) => Object.fromEntries(names.map((name) => [name, count(name)]));
  return {
    designs: part.length,
    fulfil: fulfilling.length,
    doubtful: fulfilling.filter(doubtful).length,
    coarse: fulfilling.filter((row) => row.design.coarse && !doubtful(row)).length,
    failed: each((name) => part.filter((row) => row.misses[name] > 0).length),
    unknown: each((name) => part.filter((row) => row.misses[name] === Infinity).length),
    close: each((name) => close.filter((other) => other === name).length),
    open: part.filter((row) => mayFulfil(data, row, question)).length,
  };
}

// The energy (J) that must be absorbed, of a striker or as required, the force (N) that is allowed
// meanwhile, the least stroke (m) for both, and the greatest height; null if one is not known.
function rectangle(data, rows, question) {
  const { driven, struck: hit } = data.scenes[question.scene];
  const limits = askedOf(data, question);
  const together = (row) => (ofPanel(question) ? row.panel.specimens : 1);
  const struck = () => Math.min(...rows.map((row) => together(row) * row.design.struck));
  const energy = hit ? struck() : driven ? limits.min_absorbed : undefined;
  const force = Math.min(limits.max_force ?? Infinity, question.force ?? Infinity);
  if (!(energy > 0) || force === Infinity) return null;
  return { energy, force, stroke: energy / force, height: Math.max(...rows.map((row) => row.design.height)) };
}

// Numbers of specimens of an outer width x depth (m) side by side and one behind the other, with a
// gap (m) there and `beside` between the former, of the panel nearest to two lengths (m), at least
// one each, and its true lengths; without a gap, parts of periods of a panel in one piece:
// sweep/design/panel.py.
function panelOf([first, second], { outer: [width, depth], gap }, beside) {
  if (gap === null) return { specimens: (first / width) * (second / depth), lengths: [first, second] };
  const across = Math.max(1, Math.floor((first + beside) / (width + beside) + 0.5));
  const behind = Math.max(1, Math.floor((second + gap) / (depth + gap) + 0.5));
  const lengths = [across * (width + beside) - beside, behind * (depth + gap) - gap];
  return { specimens: across * behind, lengths };
}

// What is compared of one design. question: scene, budget (g) or null, panel [m, m] or null,
// force (N) or null, require {name: limit}, and per: force and limits are of a "specimen" or "panel".
function measured(data, design, question) {
  const scene = data.scenes[question.scene];
  const panel = question.panel ? panelOf(question.panel, design, data.beside) : null;
  const factor = panel ? panel.specimens : 1;
  const force = question.force === null ? null : question.force / (ofPanel(question) ? factor : 1);
  const [energy, error, correction, stroke] = countedUntil(data, design, question, force);
  const slack = storedEnergy(data, question) < 0 ? data.round_off_of_curves : data.round_off;
  const row = {
    design,
    panel,
    mass: factor * design.mass,
    energy: times(energy, factor),
    stroke,
    perGram: ratio(energy, design.mass),
    passed: force === null ? design.passed : least(design.peak, force),
    pareto: false, // until `markFront`
    beyond: design.solid || exceeds(energy, times(design.within, 1 + slack)),
  };
  row.early = scene.driven && force !== null && design.peak !== null && design.peak <= row.passed;
  row.open = force === null ? design.open : row.early;
  const whole = question.panel || question.budget !== null; // else energy per gram is compared
  const scaled = (v) => (whole ? times(v, factor) : ratio(v, design.mass));
  [row.value, row.error, row.correction] = scene.least ? design.least : [energy, error, correction].map(scaled);
  const [low, high] = scene.least || force !== null ? [null, null] : design.ends;
  row.below = low === null ? 0 : Math.max(0, row.value - scaled(low));
  row.above = high === null ? 0 : Math.max(0, scaled(high) - row.value);
  row.misses = missesOf(data, row, question);
  row.worst = Math.max(0, ...Object.values(row.misses));
  return row;
}

// The nearest whole number, the even one of two, as numpy rounds.
function halfToEven(value) {
  const below = Math.floor(value);
  if (value - below !== 0.5) return Math.round(value);
  return below % 2 ? below + 1 : below;
}

// Merit and weight of a row on the front; where some are periods without a panel, whose sizes mean
// nothing, those of equal areas.
function ofFront(rows, scene, question) {
  if (scene.least) return [(row) => (row.value === null ? null : -row.value), (row) => row.mass];
  const area = ({ design: { outer: [width, depth] } }) => width * depth;
  const periods = !question.panel && rows.some((row) => row.design.gap === null);
  const mean = rows.reduce((sum, row) => sum + area(row), 0) / rows.length;
  const equal = (value, row) => (value === null || !periods ? value : (value / area(row)) * mean);
  return [(row) => equal(row.energy, row), (row) => equal(row.mass, row)];
}

// Marks rows such that none lighter is as good and none as light is better.
function markFront(rows, merit, weight) {
  const best = new Map();
  const key = (row) => halfToEven(weight(row) * 1e9);
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

// Places of sorted rows, doubtful ones last: a value shares the place of the first value of that
// place if it differs from it by no more than their corrections or their errors differ, if those are
// known, or than the lesser of two large errors, or if their ranges meet; but no doubtful row shares a place with one that is not.
function markPlaces(rows, large_error) {
  let best = NaN;
  let [shift, bar, low] = [NaN, NaN, NaN];
  rows.forEach((row, i) => {
    const [correction, error] = [row.correction ?? 0, row.error ?? NaN];
    const apart = i > 0 && doubtful(row) !== doubtful(rows[i - 1]);
    const large = error > large_error * Math.abs(row.value) && bar > large_error * Math.abs(best);
    const common = large ? Math.min(error, bar) : 0;
    const differ = Math.max(Math.abs(correction - shift), Math.abs(error - bar) || 0, common);
    const reached = Math.abs(row.value - best) <= differ + low + row.above;
    if (reached && !apart) row.place = rows[i - 1].place;
    else [best, shift, bar, low, row.place] = [row.value, correction, error, row.below, i + 1];
  });
  const sharing = new Map();
  for (const row of rows) sharing.set(row.place, (sharing.get(row.place) ?? 0) + 1);
  for (const row of rows) row.sharing = sharing.get(row.place);
}

// What the rest of a crush adds at most to the energy up to an allowed force, in units of the value.
function further(data, row, question) {
  const { design } = row;
  if (question.force === null || !data.scenes[question.scene].driven) return Infinity;
  const force = question.force / (ofPanel(question) ? row.panel.specimens : 1);
  if (exceeds(design.peak, force)) return 0;
  if (design.rest === null) return Infinity;
  const most = force * design.rest;
  if (!question.panel && question.budget === null) return most / design.mass;
  return row.panel ? most * row.panel.specimens : most;
}

// The best place that a stopped case could have had among rows that have one, and the place that it
// has at least, or null; nothing if it misses a requirement already.
function couldPlace(data, row, placed, question) {
  const sign = data.scenes[question.scene].least ? -1 : 1;
  const { unresolved } = row.design;
  const value = unresolved ? null : row.value;
  const low = value === null ? -Infinity : value;
  const rest = unresolved || sign < 0 ? Infinity : further(data, row, question);
  const high = value === null ? Infinity : value + rest;
  const [better, worse] = sign < 0 ? [low, high] : [high, low];
  const settled = row.energy !== null && rest === 0;
  const sure = (name) => (data.measures[name].least ? settled : !unresolved || name === "max_mass");
  const missed = ([name, share]) => share > 0 && share < Infinity && sure(name);
  if (Object.entries(row.misses).some(missed)) return null;
  const ahead = (other, end) =>
    doubtful(row) === doubtful(other) ? sign * other.value > sign * end : doubtful(row) > doubtful(other);
  const place = (end) => 1 + placed.filter((other) => ahead(other, end)).length;
  const certain = Object.keys(row.misses).every((name) => name === "max_mass") && Number.isFinite(worse);
  return { row, best: place(better), least: certain ? place(worse) : null };
}

// The cases of a scene that stopped and could have had a place among the placed ones, the best first.
function unfinished(data, placed, question) {
  const stopped = [...data.unfinished, ...data.cases.filter((design) => design.unloaded)];
  const most = greatestMass(data, question);
  return stopped
    .filter((design) => design.scene === question.scene)
    .map((design) => measured(data, design, question))
    .filter((row) => (!row.design.unloaded || row.value === null) && (row.design.mass === null || row.mass <= most))
    .map((row) => couldPlace(data, row, placed, question))
    .filter(Boolean)
    .sort((a, b) => a.best - b.best || (a.least ?? Infinity) - (b.least ?? Infinity) || (a.row.design.id < b.row.design.id ? -1 : 1));
}

function doubtful(row) {
  return Number(row.beyond || row.design.crossed);
}

// A group of designs that the page leaves out, as a row at least as good as that of each member:
// selection.py. which: "any" member, or those to be trusted, "sound". A panel takes more specimens of
// the smallest member than of the largest one.
function bestOf(data, group, question, which) {
  const count = (outer) => (question.panel ? panelOf(question.panel, { ...group, outer }, data.beside).specimens : 1);
  const best = group[which];
  const more = count(group.smallest) / count(group.outer);
  const energies = best.energies.map(([most]) => [times(most, more), null, null]);
  const stairs = best.stairs && [best.stairs[0], best.stairs[1].map((work) => more * work), best.stairs[2]];
  const row = measured(data, { ...group, ...best, energies, stairs }, question);
  const known = storedEnergy(data, question);
  if (!data.scenes[question.scene].least && !question.panel && question.budget === null && known >= 0)
    row.value = best.perGram[known];
  return row;
}

// How many of the placed rows are surely the first among all designs; designs that the page leaves
// out may share their places within errors. And whether one of these may be better than the first, or,
// where no design to be trusted has a place, meet what is required, come nearer to it, or be lighter.
function certainty(data, question, { placed, nearest, lightestMeeting }) {
  const scene = data.scenes[question.scene];
  if (!scene.others.length) return { certain: placed.length, better: false };
  const sign = scene.least ? -1 : 1;
  const most = greatestMass(data, question);
  const groupings = (which) => scene.others.map((groups) => groups.map((group) => bestOf(data, group, question, which)));
  const worths = (rows) => rows.filter((row) => row.worst === 0 && row.mass <= most && row.value !== null).map((row) => sign * row.value);
  const bounds = groupings("sound").map((rows) => Math.max(-Infinity, ...worths(rows)));
  const front = scene.least ? scene.front_of_others[0] : scene.front_of_others[storedEnergy(data, question)];
  if (front && !question.panel && (scene.least || question.budget !== null))
    bounds.push(Math.max(-Infinity, ...front[1].filter((_, i) => front[0][i] <= most)));
  const bound = Math.min(...bounds);
  const slack = storedEnergy(data, question) < 0 ? data.doubt : 0;
  const worth = (row) => sign * row.value - slack * Math.abs(row.value);
  const unsure = placed.findIndex((row) => doubtful(row) || !(worth(row) > bound));
  const certain = unsure < 0 ? placed.length : unsure;
  if (placed.length && !doubtful(placed[0])) return { certain, better: certain === 0 };
  const far = nearest && !doubtful(nearest) ? nearest.worst : Number.MAX_VALUE;
  const nearer = (row) => row.mass <= most && row.worst <= far;
  const lighter = (row) => row.worst === 0 && row.mass < (lightestMeeting?.mass ?? Infinity);
  return { certain, better: groupings("any").every((rows) => rows.some((row) => nearer(row) || lighter(row))) };
}

// All designs of a scene of known mass as `rows`; those with a place, best first, as `placed`; those
// within the budget that miss what is required, the nearest first, as `missing`; `nearest`: where no
// design to be trusted fulfils it, the first of them whose values are known; `lightestMeeting`: the
// lightest one to be trusted that fulfils it, of any mass; `stopped`: from `unfinished`;
// `passedOver`: doubtful designs whose values are better than the first.
// `refused`: whether designs cannot be compared; none of them has a place then, or is named.
// Of a page that leaves designs out: `certain` and `better` of `certainty`.
function ranked(data, question) {
  const scene = data.scenes[question.scene];
  const weighed = (design) => design.scene === question.scene && design.mass !== null;
  const rows = data.cases.filter(weighed).map((design) => measured(data, design, question));
  const sign = scene.least ? 1 : -1;
  const sound = (row) => !doubtful(row);
  const small = isTooSmall(data, question);
  const refused = small || incomparable(data, question);
  const comparable = refused ? [] : rows;
  const meeting = comparable.filter((row) => row.worst === 0);
  markFront(meeting.filter(sound), ...ofFront(meeting.filter(sound), scene, question));
  const most = greatestMass(data, question);
  const within = meeting.filter((row) => row.mass <= most);
  const placed = within.filter((row) => row.value !== null);
  const byId = (a, b) => (a.design.id < b.design.id ? -1 : 1);
  const byMass = (a, b) => a.mass - b.mass || byId(a, b);
  placed.sort((a, b) => doubtful(a) - doubtful(b) || sign * (a.value - b.value) || byMass(a, b));
  const missing = comparable.filter((row) => row.worst > 0 && row.mass <= most);
  const further = (a, b) => (a.worst === b.worst ? 0 : a.worst - b.worst);
  missing.sort((a, b) => doubtful(a) - doubtful(b) || further(a, b) || byMass(a, b));
  const known = storedEnergy(data, question);
  const bar = scene.least ? scene.bar : known >= 0 && data.energies[known].bar;
  markPlaces(placed, data.large_error);
  const nearest = within.some(sound) ? undefined : missing.find((row) => row.worst < Infinity);
  const passedOver = placed.filter((row) => sign * (row.value - placed[0].value) < 0 && doubtful(row) > doubtful(placed[0])).length;
  const [lightestMeeting] = meeting.filter(sound).sort(byMass);
  const lightest = Math.min(...rows.map((row) => row.mass));
  const stopped = refused ? [] : unfinished(data, placed, question);
  const sure = certainty(data, question, { placed, nearest, lightestMeeting });
  return { rows, refused, small, placed, missing, nearest, bar, lightest, lightestMeeting, stopped, passedOver, ...sure };
}
