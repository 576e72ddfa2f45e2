// The page: what is asked, the ranking, and the designs that are chosen in it.

const data = JSON.parse(document.getElementById("data").textContent);
const $ = (id) => document.getElementById(id);
const NAMED = 3; // stopped cases below the answer
const SHOWN = 15; // rows of the table before all are asked for
const MANY = 150; // designs of a scene: their dots are smaller
const COLORS = 6;
const HUES = 8;
const HUED = ["pattern", "material", "pressed"]; // heads whose choices dots may be coloured by
const NARROW = 560; // px: the window of a phone, as in page.css
const LINKED = 300; // ms after which a question is in the address
const FIRST = 3; // best designs whose curves are shown until others are chosen
const PER_SECOND = 12; // frames
const WORDS = new Intl.Collator("en", { numeric: true }); // "6 x 2" before "12 x 4"
const ANY_FORCE = { low: 1, high: 1e4 }; // N, where no peak is known
const LENGTH = { low: 10, high: 1000 }; // mm, of a panel
const SIDE = 100; // mm, of a panel until another is asked for
const MOST = 1e12; // below every greatest number of the terminal

const asked = { scene: 0, budget: null, panel: null, force: null, require: {}, per: "specimen" };
const view = { sort: null, up: true, all: false, chosen: null, current: null, frame: 0, timer: null };
let now = null; // the ranking that is shown
let player = null;
let linking = null;
let printed = null; // address of the file to print

function scene() {
  return data.scenes[asked.scene];
}

function crushed() {
  return scene().driven;
}

// ---- what is asked ----

// Positions 0 to 1000 of a slider stand for values from low to high, by equal ratios.
const slide = {
  value: (place, { low, high }) => low * (high / low) ** (place / 1000),
  place: (value, { low, high }) => (1000 * Math.log(value / low)) / Math.log(high / low),
};

function massRange() {
  const masses = now.rows.map((row) => row.mass);
  return { low: 0.95 * Math.min(...masses), high: 1.05 * Math.max(...masses) };
}

// Of a specimen or of the panel.
function forceRange() {
  const count = (design) => (ofPanel(asked) ? panelOf(asked.panel, design, data.beside).specimens : 1);
  const known = data.cases.filter((design) => design.scene === asked.scene && design.peak > 0);
  const peaks = known.map((design) => count(design) * design.peak);
  return peaks.length ? { low: 0.5 * Math.min(...peaks), high: 1.05 * Math.max(...peaks) } : ANY_FORCE;
}

function three(value) {
  return Number(value.toPrecision(3));
}

// The number of an input, null unless the terminal takes it for a mass, a length or a force.
function numberIn(input) {
  const value = Number(input.value);
  return value > 0 && value < MOST ? value : null;
}

// A slider, its number and its check box. `on` tells the wish, null if the box is off.
function wish(name, range, unit, on) {
  const [slider, number, box] = [$(`${name}-slide`), $(name), $(`${name}-on`)];
  const typed = () => times(numberIn(number), unit());
  const tell = (value) => {
    if (value === null && !box) return;
    on(value);
    refresh();
  };
  slider.addEventListener("input", () => {
    number.value = three(slide.value(Number(slider.value), range()) / unit());
    tell(typed());
  });
  number.addEventListener("input", () => tell(typed()));
  if (box) box.addEventListener("change", () => tell(box.checked ? (typed() ?? slide.value(Number(slider.value), range())) : null));
  return (value) => {
    const { low, high } = range();
    slider.value = slide.place(Math.min(Math.max(value, low), high), { low, high });
    if (document.activeElement !== number) number.value = Number((value / unit()).toPrecision(6));
  };
}

const gramsPerUnit = () => Number($("unit").value);

// The unit in which all budgets are hundredths; the first one if none is.
function unitOf(budgets) {
  const isRound = (unit) => budgets.every((grams) => Math.abs((100 * grams) / unit - Math.round((100 * grams) / unit)) < 1e-6);
  const units = [...$("unit").options].map((option) => option.value);
  return units.find((unit) => isRound(Number(unit))) ?? units[0];
}

const showBudget = wish("budget", massRange, gramsPerUnit, (grams) => (asked.budget = grams));
const showForce = wish("force", forceRange, () => 1, (newtons) => (asked.force = newtons));
const sidesOf = () => ["width", "height"].map((name, k) => asked.panel?.[k] ?? toSI(numberIn($(name)) ?? SIDE, "mm"));
const setSide = (side) => (mm) => {
  asked.panel = sidesOf().map((other, k) => (k === side ? toSI(mm, "mm") : other));
};
const showWidth = wish("width", () => LENGTH, () => 1, setSide(0));
const showHeight = wish("height", () => LENGTH, () => 1, setSide(1));

function picks(box, values, words, key, chosen) {
  box.replaceChildren(
    ...values.map((value) =>
      element(
        "button",
        {
          type: "button",
          "aria-pressed": String(Math.abs(chosen - value) < 1e-9 * value),
          onclick: () => {
            asked[key] = value;
            refresh();
          },
        },
        words(value),
      ),
    ),
  );
}

// Wishes that make no sense in the scene are dropped.
function settle() {
  const designs = data.cases.filter((design) => design.scene === asked.scene);
  const sized = designs.every((design) => design.outer.every((side) => side > 0));
  const unpaneled = !asked.panel && designs.some(isPeriod);
  $("panel-box").hidden = !sized;
  $("budget-box").hidden = unpaneled;
  const forced = crushed() && (asked.panel || asked.per !== "panel"); // no panel has no force
  $("force-box").hidden = !forced;
  if (!sized) asked.panel = null;
  if (unpaneled) asked.budget = null; // the mass of a period says nothing about that of a part
  if (!forced) asked.force = null;
  $("per-box").hidden = !asked.panel && asked.per !== "panel";
}

// A box and a number for each requirement that the scene can be asked for, in a maker's unit.
function showRequired() {
  const known = Object.entries(data.measures).filter(([name]) => scene().requires.includes(name));
  $("require-box").hidden = !known.length;
  $("per").value = asked.per;
  for (const input of [...$("require").children]) input.hidden = !known.some(([name]) => name === input.dataset.name);
  for (const [name, { shown }] of known) {
    const [box, number] = [$(`${name}-on`), $(name)];
    box.checked = asked.require[name] !== undefined;
    if (box.checked && document.activeElement !== number) number.value = Number(inUnits(asked.require[name], shown).toPrecision(6));
  }
}

function makeRequired() {
  for (const [name, { shown, limit }] of Object.entries(data.measures)) {
    const words = limit.replace(/ *\{\}/, "");
    const box = element("input", { type: "checkbox", id: `${name}-on` });
    const number = element("input", { type: "number", id: name, min: 0, step: "any", "aria-label": `${words}, ${shown}` });
    const tell = () => {
      const value = numberIn(number);
      if (box.checked && value !== null) asked.require[name] = toSI(value, shown);
      else delete asked.require[name];
      Object.assign(view, { chosen: null, current: null });
      refresh();
    };
    box.addEventListener("change", tell);
    number.addEventListener("input", () => {
      box.checked = true;
      tell();
    });
    $("require").append(element("span", { "data-name": name }, element("label", {}, box, ` ${words}`), number, shown));
  }
  $("per").addEventListener("change", () => {
    asked.per = $("per").value;
    refresh();
  });
}

function limitText(name, value) {
  const { shown } = data.measures[name];
  if (name === "min_absorbed") return energyText(value);
  return `${Number(inUnits(value, shown).toPrecision(4))} ${shown}`;
}

// What is required, and how many designs within the budget fulfil it.
function requiredText() {
  const limits = askedOf(data, asked);
  const nouns = (names) => names.map((name) => data.measures[name].noun).join(", ");
  const others = Object.keys(asked.require).filter((name) => !(name in limits));
  if (others.length && asked.per === "panel" && !asked.panel) return "Requirements on a panel are not applied, as there is no panel.";
  const left = others.length ? `Not applied to this loading: ${nouns(others)}.` : "";
  if (!Object.keys(limits).length) return left;
  const words = Object.entries(limits).map(([name, limit]) => data.measures[name].limit.replace("{}", limitText(name, limit)));
  const required = `Required of ${asked.per === "panel" ? "a panel" : ofOne()}: ${words.join(", ")}.`;
  const outcome = outcomeOf(data, now, asked);
  const counts = outcome.designs ? [fulfilText(outcome), ...uncertainText(outcome)] : [];
  return [required, ...counts, left].filter(Boolean).join(" ");
}

function counted(numbers) {
  return Object.entries(numbers).filter(([, n]) => n);
}

// How many designs fulfil what is required, and how many fail each part of it.
function fulfilText({ designs, fulfil, doubtful: marked, failed }) {
  const within = asked.budget === null ? "" : ` up to ${inUnit(asked.budget)}`;
  const trusted = marked ? `, ${marked} of them marked ! or x` : "";
  const each = counted(failed).map(([name, n]) => `${data.measures[name].noun} (${n})`);
  const several = counted(failed).reduce((sum, [, n]) => sum + n, 0) > designs - fulfil ? "; some fail several" : "";
  return `${fulfil} of ${designs} designs${within} fulfil this${trusted}${each.length ? `; the others fail: ${each.join(", ")}${several}` : ""}.`;
}

// Which of these counts are not certain.
function* uncertainText({ fulfil, coarse, unknown, close, open }) {
  const one = coarse === 1;
  const some = coarse < fulfil ? `${coarse} of those that do ${one ? "is" : "are"}` : one ? "It is" : "All of these are";
  if (coarse) yield `${some} marked i: with shorter steps ${one ? "it" : "they"} may fail.`;
  for (const [name, n] of counted(unknown)) yield `${n} without a value for ${data.measures[name].noun}: ${data.measures[name].unknown}.`;
  for (const [name, n] of counted(close))
    yield `${n} ${n === 1 ? "meets or misses" : "meet or miss"} the limit of ${data.measures[name].noun} by less than the uncertainty of the value.`;
  if (open)
    yield `${open} of those that fail may absorb enough in a longer crush: ` +
      `theirs ended before ${asked.force === null ? "densification" : "the allowed force was reached"}.`;
}

// The requirements that a row misses, with its values.
function missText(row) {
  const found = required(data, row, asked);
  return Object.entries(row.misses)
    .filter(([, share]) => share > 0)
    .map(([name, share]) => {
      const { noun, far } = data.measures[name];
      if (share === Infinity) return `${noun} unknown`;
      if (name === "min_absorbed" && row.open)
        return `${noun} at least ${limitText(name, found[name])}, at most ${percents(share)} % ${far}`;
      return `${noun} ${limitText(name, found[name])}, ${percents(share)} % ${far}`;
    })
    .join("; ");
}

// The lightest design that fulfils what is required, above the budget; else the stroke that it takes.
function* instead() {
  const lightest = now.lightestMeeting;
  const needed = rectangle(data, now.rows, asked);
  if (lightest) yield `The lightest design that fulfils this weighs ${inUnit(lightest.mass, 3)}: ${lightest.design.label}.`;
  else if (needed)
    yield `Absorbing ${energyText(needed.energy)} at no more than ${limitText("max_force", needed.force)} takes a stroke of at least ` +
      `${digits(inUnits(needed.stroke, "mm"))} mm (energy / force); the lattice is ${digits(inUnits(needed.height, "mm"))} mm high.`;
}

function* nearestText() {
  const row = now.nearest;
  const doubt = doubtful(row) ? ` (marked ${row.beyond ? "!" : ""}${row.design.crossed ? "x" : ""}: do not trust it)` : "";
  yield `Nearest: ${row.design.label}${doubt}: ${missText(row)}.`;
  yield* noneText(row);
}

// The requirements that no design within the budget fulfils, with the best value, if the nearest design does not have it.
function* noneText(nearest) {
  const part = now.rows.filter((row) => row.mass <= greatestMass(data, asked));
  const trusted = (name) => part.filter((row) => !doubtful(row) && row.misses[name] < Infinity);
  for (const [name, limit] of Object.entries(askedOf(data, asked))) {
    if (part.some((row) => row.misses[name] === 0)) continue;
    const { least, none } = data.measures[name];
    const sound = trusted(name);
    const known = sound.length ? sound : part.filter((row) => row.misses[name] < Infinity);
    const values = known.map((row) => required(data, row, asked)[name]);
    const best = least ? Math.max(...values) : Math.min(...values);
    if (!values.length || required(data, nearest, asked)[name] === best) continue;
    const unsure = sound.length ? "" : " (marked ! or x: do not trust it)";
    yield `${[limit, best].reduce((words, value) => words.replace("{}", limitText(name, value)), none)}${unsure}.`;
  }
}

function showAsked() {
  $("scene-words").textContent = scene().label;
  showRequired();
  const { low, high } = massRange();
  $("budget-on").checked = asked.budget !== null;
  $("panel-on").checked = asked.panel !== null;
  $("force-on").checked = asked.force !== null;
  for (const name of ["budget", "panel", "force"])
    $(`${name}-box`).classList.toggle("off", asked[name] === null);
  showBudget(asked.budget ?? (times(numberIn($("budget")), gramsPerUnit()) ?? Math.sqrt(low * high)));
  if (crushed()) showForce(asked.force ?? (numberIn($("force")) ?? three(Math.sqrt(forceRange().low * forceRange().high))));
  const [width, height] = sidesOf();
  showWidth(inUnits(width, "mm"));
  showHeight(inUnits(height, "mm"));
  picks($("budgets"), data.question.budgets_g, (grams) => inUnit(grams), "budget", asked.budget);
  const forces = data.energies.map((energy) => energy.force).filter((force) => force !== null);
  picks($("forces"), ofPanel(asked) ? [] : forces, (newtons) => `${Number(newtons.toPrecision(6))} N`, "force", asked.force);
  $("force-of").textContent = ofOne();
}

// ---- the answer ----

function inUnit(grams, figures = 4) {
  return `${Number((grams / gramsPerUnit()).toPrecision(figures))} ${gramsPerUnit() === 1 ? "g" : "oz"}`;
}

// A share in percent, two digits.
function percents(share) {
  return Number(inUnits(share, "%").toPrecision(2));
}

function percentOf(row) {
  return row.error === null || row.error === undefined || !row.value ? "" : ` ± ${share(row)} %`;
}

function share(row) {
  const percent = inUnits(row.error / Math.abs(row.value), "%");
  if (percent > 0 && percent < 0.05) return "< 0.1";
  return percent < 9.95 ? percent.toFixed(1) : percent.toFixed(0);
}

function valueText(row) {
  const { shown } = scene();
  if (shown) return shown.merit.replace("{}", digits(inUnits(row.value, shown.unit)));
  const least = row.early ? "at least " : "";
  const whole = asked.panel || asked.budget !== null; // energy is ranked, not energy per gram
  return least + (whole ? energyText(row.energy) : `${digits(row.perGram)} J/g`);
}

// The true lengths of a panel, in mm.
function panelText(row) {
  return row.panel.lengths.map((side) => Number(inUnits(side, "mm").toPrecision(3))).join(" x ");
}

// Of a panel in one piece, which has as many of them as its area does.
function isPeriod(design) {
  return design.gap === null;
}

// To what masses and forces of the scene refer: `of_one` of requirement_notes.py.
function oneOf(part) {
  const designs = data.cases.filter((design) => design.scene === asked.scene);
  if (designs.every(isPeriod)) return "one period";
  return designs.some(isPeriod) ? `${part} or one period` : part;
}

// What an allowed force and requirements are of.
function ofOne() {
  if (ofPanel(asked)) return "the panel";
  return oneOf(asked.panel ? "a specimen" : "the part");
}

function until() {
  if (asked.force === null) return data.energies[0].until;
  const noun = ofOne();
  return `until the force of ${noun} exceeds ${Number(asked.force.toPrecision(6))} N`;
}

// The drawing of a design, if the page has it.
function drawn(design) {
  return data.drawings[design.drawing] ? [drawingOf(data.drawings[design.drawing])] : [];
}

function showPicture({ design }) {
  $("picture").append(...drawn(design));
}

function showAnswer() {
  const best = now.placed[0];
  const limit = asked.budget === null ? "" : ` up to ${inUnit(asked.budget)}`;
  for (const name of ["picture", "command", "print"]) $(name).replaceChildren();
  if (now.refused) {
    $("sentence").textContent = now.small
      ? "No design is named, as the panel is smaller than half of a specimen."
      : `No design is named, as ${data.unequal}. Fill a panel, and set limits per panel.`;
    $("detail").textContent = "";
    return;
  }
  if (!best) {
    const none = asked.budget !== null && Number.isFinite(now.lightest) && greatestMass(data, asked) < now.lightest;
    $("sentence").textContent = none
      ? `No design weighs ${inUnit(asked.budget, 6)} or less; the lightest weighs ${inUnit(now.lightest, 6)}.`
      : "No design has a value to rank by.";
    const missed = !none && now.missing.length > 0;
    if (missed) $("sentence").textContent = `No design${limit} meets the requirements.`;
    if (now.nearest) showPicture(now.nearest);
    const more = [...(now.nearest ? nearestText() : []), ...(missed ? instead() : []), ...lackText(), ...stoppedText()];
    $("detail").textContent = [requiredText(), ...more].filter(Boolean).join(" ");
    showCommand();
    return;
  }
  $("sentence").replaceChildren(
    `The best design${limit} is `,
    element("strong", {}, best.design.label),
    `: ${valueText(best)}${percentOf(best)}.`,
  );
  showPicture(best);
  $("detail").textContent = detail(best).join(" ");
  showCommand();
  showPrint(best.design);
}

function showPrint(design) {
  const [file, command] = [data.prints[design.id], exportCommand(design, data.file, asked.panel)];
  URL.revokeObjectURL(printed);
  if (!command) return;
  $("print").append(`To print ${asked.panel && !isPeriod(design) ? "a specimen" : "it"}: `);
  if (file) {
    printed = URL.createObjectURL(new Blob([bytesOf(file)], { type: "model/3mf" }));
    const name = fileName(design, "3mf");
    $("print").append(element("a", { id: "print-file", href: printed, download: name }, name), ", with 100 % infill; or ");
  }
  $("print").append(element("code", {}, command));
}

function fileName({ id }, ending) {
  return `${data.name}_${id}.${ending}`.replace(/[^\w.-]/g, "_");
}

function* words(best) {
  const panel = best.panel
    ? `A panel of ${panelText(best)} mm${isPeriod(best.design) ? "" : `, ${best.panel.specimens} specimen${best.panel.specimens > 1 ? "s" : ""},`} weighs ${inUnit(best.mass)}`
    : `${isPeriod(best.design) ? "One period" : "It"} weighs ${inUnit(best.mass)}`;
  const absorbs = () => `absorbs ${best.early ? "at least " : ""}${energyText(best.energy)}`;
  if (scene().least) yield `${panel}.`;
  else if (!crushed()) yield `${panel} and ${absorbs()}, ${digits(best.perGram)} J/g.`;
  else
    yield `${panel} and ${absorbs()} ${until()}, ${digits(best.perGram)} J/g` +
      (best.passed === null ? "; the force meanwhile is not known." : `; ${isPeriod(best.design) ? "one period" : asked.panel ? "a specimen" : "it"} then transmits ${digits(best.passed)} N${best.panel ? `, the panel ${digits(best.panel.specimens * best.passed)} N` : ""}.`);
  if (best.early) yield "The crush ended before that force was reached; a longer one absorbs more.";
  if (best.beyond) yield "Its result is beyond the model: do not trust it.";
  if (best.design.crossed) yield "Its walls cross one another: do not trust this result.";
  const others = marksOf(best).replace(/[!xp]/g, ""); // which are explained here
  if (others) yield `It is marked ${[...others].join(", ")}: see below the table.`;
  if (best.design.undrawn) yield `It does not print as drawn: ${best.design.undrawn}.`;
  const tied = now.placed.filter((row) => row !== best && row.place === best.place);
  const shown = tied.slice(0, 3).map((row) => row.design.label).join("; ");
  if (tied.length)
    yield `Tied${now.bar ? " within the estimated errors" : ""}: ${shown}${tied.length > 3 ? ` and ${tied.length - 3} more` : ""}.`;
}

// Whether something is required that no design to be trusted fulfils within the budget.
function unmet() {
  const limits = Object.keys(askedOf(data, asked)).length > 0;
  return limits && !now.placed.some((row) => !doubtful(row));
}

function detail(best) {
  return [...words(best), requiredText(), ...(now.nearest ? nearestText() : []), ...(unmet() ? instead() : []), ...lackText(), ...stoppedText()].filter(Boolean);
}

// What the page may lack, as it does not hold all designs.
function* lackText() {
  if (now.better) yield "A design that this page leaves out may be better for this question: crumple rank compares all.";
}

// What the page holds, and how far its places are those among all designs.
function* partText() {
  if (!scene().others.length) return; // the page has all designs of the scene
  yield `This page holds ${now.rows.length} of ${scene().designs} designs: the best within every budget, per gram and per area, until densification ` +
    "and up to the forces of the columns, the best below some limits, and a sample of the others. Numbers of designs are of these.";
  const { certain, placed } = now;
  if (certain > 0 && certain < placed.length)
    yield `The first ${certain === 1 ? "design is the first" : `${certain} designs are the first`} among all; between and behind the others may be more.`;
  else if (!certain && placed.length) yield "Places are among the designs of the page.";
  yield "Designs that it leaves out may share places.";
}

// The stopped cases that could have had a place, each with its reason: unfinished_notes.py.
function* stoppedText() {
  const most = now.placed.length > SHOWN ? SHOWN : Infinity;
  const stopped = now.stopped.filter((one) => one.best <= most);
  for (const { row, best, least } of stopped.slice(0, NAMED)) {
    const place = least === null ? `could have had place ${best}`
      : `would have place ${least}${best < least ? " or better" : ""}, by what it had reached`;
    yield `Unfinished: ${row.design.label}: ${place}; ${row.design.message}.`;
  }
  const more = stopped.length - NAMED;
  const others = scene().stopped ? `, and so could ${scene().stopped} that this page leaves out` : "";
  if (more > 0) yield `${more} more unfinished case${more > 1 ? "s" : ""} could have had a place${others}: see the failed cases below.`;
}

// The command that prints the same ranking, if there is one.
function showCommand() {
  if (asked.per === "panel" && !asked.panel) return;
  const unweighed = asked.budget !== null && !asked.panel && data.cases.some(isPeriod);
  if (unweighed || data.scenes.some((_, scene) => incomparable(data, { ...asked, scene })))
    return $("command").append("crumple rank refuses this question, as another scene of this file has periods of wide panels.");
  const budgeted = asked.budget !== null || !data.question.budgets_g.length;
  const paneled = asked.panel !== null || !data.question.panel;
  if (!(budgeted && paneled)) return;
  const budget = asked.budget === null ? "" : ` --budget "${inUnit(asked.budget, 9)}"`;
  const panel = asked.panel ? ` --panel ${asked.panel.map((side) => `"${Number(inUnits(side, "mm").toPrecision(6))} mm"`).join(" ")}` : "";
  const force = asked.force === null ? "" : ` --allowed-force "${asked.force} N"`;
  $("command").append("In a terminal: ", element("code", {}, `crumple rank ${wordOf(data.file)}${budget}${panel}${force}${requiredOptions()}`));
}

// The options that differ from what the config of the file requires.
function requiredOptions() {
  const { require, per } = data.question;
  const options = Object.entries(data.measures).flatMap(([name, { shown }]) => {
    if (asked.require[name] === require[name]) return [];
    const value = asked.require[name] === undefined ? "none" : `"${Number(inUnits(asked.require[name], shown).toPrecision(12))} ${shown}"`;
    return [` --${name.replaceAll("_", "-")} ${value}`];
  });
  return options.join("") + (asked.per === per ? "" : ` --per ${asked.per}`);
}

// ---- the table ----

function columns() {
  const { shown } = scene();
  const number = (head, text, key = null) => ({ head, text, key: key ?? ((row) => parseFloat(text(row).replace(/^[>~ ]+/, ""))), right: true });
  const found = [number("#", (row) => placeText(row), (row) => row.rank)];
  data.heads.forEach((head, i) => {
    const text = (row) => row.design.text[i];
    found.push({ head, text, key: (row) => (text(row) === "" ? "" : Number.isNaN(Number(text(row))) ? text(row) : Number(text(row))) });
  });
  found.push(number("mass g", (row) => digits(row.design.net)));
  if (data.printed) found.push(number("print g", (row) => digits(row.design.printed)));
  if (asked.panel) {
    found.push(number("panel mm", panelText, (row) => row.panel.lengths[0]));
    found.push(number("panel g", (row) => digits(row.mass)));
  }
  if (shown) found.push(number(shown.head, (row) => digits(inUnits(row.value, shown.unit)), (row) => row.value));
  if (shown && asked.panel && scene().struck)
    found.push(number("panel N", (row) => digits(times(row.design.peak, row.panel.specimens))));
  if (!shown) {
    const most = Math.max(...now.placed.map((row) => row.energy ?? 0));
    const unit = energyUnit(most);
    const more = (row) => (row.early ? "> " : "");
    found.push(number(`${asked.panel ? "panel" : crushed() ? "usable" : "absorbed"} ${unit}`, (row) => more(row) + digits(inUnits(row.energy, unit)), (row) => row.energy));
    found.push(number("J/g", (row) => more(row) + digits(row.perGram), (row) => row.perGram));
    if (crushed()) {
      found.push(number("peak N", (row) => digits(row.passed), (row) => row.passed));
      if (asked.panel)
        found.push(number("panel N", (row) => digits(times(row.passed, row.panel.specimens)), (row) => times(row.passed, row.panel.specimens)));
    }
  }
  if (now.bar) found.push(number("± %", (row) => (percentOf(row) ? share(row) : "?")));
  if (asked.force === null)
    scene().heads.forEach((head, i) => found.push(number(head, (row) => row.design.more[i])));
  for (const [head, value] of requiredColumns()) found.push(number(head, (row) => digits(value(row)), value));
  return found;
}

// Columns of what is required that the table does not have by itself: requirement_notes.py.
function requiredColumns() {
  const limits = askedOf(data, asked);
  const found = [];
  const felt = [["max_deceleration", "decel.", "deceleration"], ["max_base_pressure", "base", "pressure"], ["max_target_acceleration", "target", "accelerated"]];
  for (const [name, head, value] of felt)
    if (name in limits) {
      const { shown } = data.measures[name];
      found.push([`${head} ${shown}`, (row) => row.design[value] && inUnits(row.design[value], shown)]);
    }
  const limited = crushed() && (asked.force !== null || "max_force" in limits);
  if ((limited || "max_stroke" in limits) && now.placed.some((row) => row.stroke !== null))
    found.push(["stroke mm", (row) => row.stroke && inUnits(row.stroke, "mm")]);
  return found;
}

// The marks of its design, and whether it is beyond the model, which the question decides: marks.py.
function marksOf({ beyond, design: { marks } }) {
  return beyond ? `!${marks.replace("s", "")}` : marks;
}

function placeText(row) {
  return `${row.place}${row.sharing > 1 ? "=" : ""}${row.pareto ? "*" : ""}${marksOf(row)}`;
}

function sorted(shown) {
  now.placed.forEach((row, i) => (row.rank = i));
  const by = shown.find((column) => column.head === view.sort);
  if (!by) return now.placed;
  const last = (v) => v === null || v === "" || v === "–" || Number.isNaN(v);
  return [...now.placed].sort((a, b) => {
    const [u, v] = [by.key(a), by.key(b)];
    if (last(u) || last(v)) return last(u) - last(v) || a.rank - b.rank;
    const order = typeof u === "number" && typeof v === "number" ? u - v : WORDS.compare(u, v);
    return (view.up ? 1 : -1) * order || a.rank - b.rank;
  });
}

// On a phone what is compared comes first: place, infill, energy, energy per gram, mass.
function arranged(shown) {
  if (window.innerWidth > NARROW) return shown;
  const noun = asked.panel ? "panel" : crushed() ? "usable" : "absorbed";
  const heads = ["#", "pattern", scene().shown?.head, `${noun} J`, `${noun} mJ`, "J/g", asked.panel ? "panel g" : data.printed ? "print g" : "mass g"];
  const early = heads.flatMap((head) => shown.filter((column) => column.head === head));
  return [...early, ...shown.filter((column) => !early.includes(column))];
}

function showTable() {
  const shown = arranged(columns());
  const heads = shown.map((column) => {
    const order = column.head === (view.sort ?? "#") ? (view.sort === null || view.up ? "ascending" : "descending") : null;
    const turn = () => {
      [view.sort, view.up] = [column.head, view.sort === column.head ? !view.up : true];
      showTable();
    };
    return element("th", { scope: "col", class: column.right ? "number" : null, "aria-sort": order },
      element("button", { type: "button", onclick: turn }, column.head.replace(/ (?=[^ ]+$)/, "\n")));
  });
  $("table").tHead.replaceChildren(element("tr", {}, element("th", { "aria-label": "curve shown" }), ...heads));
  const rows = sorted(shown);
  const most = view.all ? rows.length : SHOWN;
  $("table").tBodies[0].replaceChildren(...rows.slice(0, most).map((row) => tableRow(row, shown)));
  $("all").hidden = rows.length <= SHOWN;
  $("all").textContent = view.all ? `Show ${SHOWN}` : `Show all ${rows.length}`;
}

function tableRow(row, shown) {
  const { id, label } = row.design;
  const box = element("input", { type: "checkbox", "aria-label": `curve of ${label}`, onchange: () => choose(id, box.checked) });
  box.checked = chosen().includes(id);
  const cells = shown.map((column) => element("td", { class: column.right ? "number" : null }, column.text(row)));
  return element(
    "tr",
    {
      "data-id": id,
      class: id === current() ? "current" : null,
      onclick: (event) => event.target !== box && lookAt(id),
      onmouseenter: () => near(id, true),
      onmouseleave: () => near(id, false),
    },
    element("td", {}, element("span", { class: "chosen" }, box, ...drawn(row.design))),
    ...cells,
  );
}

function near(id, on) {
  for (const dot of document.querySelectorAll(`[data-dot="${id}"]`)) dot.classList.toggle("near", on);
}

// What separate specimens of a panel leave open, and how it differs from the one of the question: `panel_note` of requirement_notes.py.
function* panelNotes() {
  if (!asked.panel || !now.placed.length || !(crushed() || scene().struck)) return;
  const rows = now.placed.filter((row) => !isPeriod(row.design));
  if (!rows.length) return yield data.whole_panel.replace("{}", panelText(now.placed[0]));
  const counts = rows.map((row) => row.panel.specimens);
  if (Math.max(...counts) > 1) yield data.one_by_one;
  if (Math.min(...counts) < Math.max(...counts)) yield `The number of specimens differs, so that places depend on it: compare J/g, or choose sides that all fill.`;
  const apart = Math.max(...rows.flatMap((row) => row.panel.lengths.map((side, k) => Math.abs(side / asked.panel[k] - 1))));
  const sides = asked.panel.map((side) => Number(inUnits(side, "mm").toPrecision(4))).join(" x ");
  if (apart > data.tolerated) yield `Whole specimens make a panel whose sides differ by up to ${percents(apart)} % from the ${sides} mm of the question. Mass, energy and force are of the panel that they make.`;
}

function notes() {
  const lines = [`*: on the Pareto front: no lighter design ${scene().front}. mass: of ${oneOf(asked.panel ? "one specimen" : "the part")}.`];
  const rows = now.placed;
  lines.unshift(...partText());
  if (data.printed) lines.push(data.printed);
  if (crushed()) lines.push(`Energy and peak are counted ${until()}.`);
  if (!(crushed() && asked.force !== null)) lines.push(...scene().meanings);
  if (!asked.panel) lines.push(...scene().sizes);
  lines.push(...scene().narrow);
  lines.push(...panelNotes());
  if (asked.panel && scene().struck && !now.rows.every((row) => isPeriod(row.design))) lines.push(data.struck_panel);
  lines.push(...requiredColumns().map(([head]) => data.column_notes[head]));
  if (storedEnergy(data, asked) < 0)
    lines.push(
      `These energies and strokes are read from curves of at most ${data.points} points: the error of an energy is at most ` +
        `${Math.max(inUnits(data.doubt, "%"), 0.1).toFixed(1)} %, if it exceeds 1 % of that of the whole crush. ` +
        "The terminal may decide otherwise where a limit is met or missed by less. " +
        (data.energies.length > 1 && !ofPanel(asked) ? "At the forces below the slider they are exact." : ""),
    );
  if (now.bar) lines.push("±: estimated error from mesh and steps, not a bound.");
  if (now.bar && rows.some((row) => !percentOf(row))) lines.push(data.unknown_error);
  if (rows.some((row) => row.sharing > 1))
    lines.push(now.bar ? data.ties.errors : data.ties.values);
  if (rows.some((row) => row.early)) lines.push(">: at least: the crush ended before that force was reached.");
  if (rows.some((row) => row.early && row.place > 1)) lines.push("The first place is not certain: in a longer crush (loading.strain) a design with > may lead.");
  lines.push(...scene().marks.filter((words) => rows.some((row) => marksOf(row).includes(words[0]))));
  if (now.passedOver) lines.push(`By value alone, ${now.passedOver} design${now.passedOver > 1 ? "s" : ""} marked ! or x would stand before the first.`);
  const over = now.rows.length - rows.length - now.missing.length;
  if (over > 0 && asked.budget !== null && !now.refused) lines.push(`${over} of ${now.rows.length} designs are above the budget or have no value.`);
  $("notes").replaceChildren(...lines.map((words) => element("span", {}, words)));
}

// ---- merit over mass ----

function merit(row) {
  return scene().least ? row.value : row.energy;
}

// A function from a design to its colour: by what has the most choices among `HUED`, whose choices
// are shown above the chart. The first ones have colours of their own.
function hues() {
  const choices = data.heads.map((head, i) => (HUED.includes(head) ? [...new Set(data.cases.map((design) => design.text[i]))].sort() : []));
  const most = choices.findIndex((words) => words.length > 1 && words.length === Math.max(...choices.map((each) => each.length)));
  const color = (k) => `--c${k < HUES ? k : 5}`;
  const legend = (choices[most] ?? []).map((word, k) => element("span", {}, swatch(color(k)), word));
  $("hues").replaceChildren(...legend);
  return (design) => (most < 0 ? "--accent" : color(choices[most].indexOf(design.text[most])));
}

function showMap() {
  const { shown: least } = scene();
  const perArea = !least && !asked.panel && now.rows.some((row) => isPeriod(row.design)); // as `ofFront`
  const noun = asked.panel ? "of a panel" : perArea ? "per cm² pressed" : "of a part";
  const area = ({ design: { outer } }) => (perArea ? 1e4 * outer[0] * outer[1] : 1);
  const massOf = (row) => row.mass / area(row);
  const rows = now.rows.filter((row) => merit(row) > 0);
  const energy = ["Energy over mass", `energy ${noun}`, energyUnit(Math.max(...rows.map((row) => merit(row) / area(row))))];
  const [title, quantity, unit] = least ? [least.chart, least.quantity, least.unit] : energy;
  $("map-title").textContent = title;
  if (!rows.length) return $("map").replaceChildren("Nothing to draw.");
  const masses = rows.map(massOf);
  const shown = (row) => inUnits(merit(row) / area(row), unit);
  const values = rows.map(shown);
  const plot = chart($("map"), {
    x: { range: logExtent(masses), label: `mass ${noun}, g`, log: true },
    y: { range: logExtent(values), label: `${quantity}, ${unit}`, log: true },
    height: 400,
    label: title,
  });
  showLimit(plot);
  const front = rows.filter((row) => row.pareto).sort((a, b) => massOf(a) - massOf(b));
  const steps = front.flatMap((row, i) => [...(i ? [[massOf(row), shown(front[i - 1])]] : []), [massOf(row), shown(row)]]);
  line(plot, steps.map(([mass]) => mass), steps.map(([, value]) => value), { class: "front" });
  const hue = hues();
  const behind = (row) => row.place !== undefined && row.pareto;
  for (const row of [...rows].sort((a, b) => behind(a) - behind(b))) dot(plot, row, massOf(row), shown, hue(row.design));
}

function showLimit(plot) {
  const x = asked.budget === null ? Infinity : plot.toX(asked.budget);
  if (!(x > MARGIN.left && x < plot.right)) return;
  const early = x > plot.right - 80;
  plot.svg.append(
    shape("line", { class: "limit", x1: x, x2: x, y1: MARGIN.top, y2: plot.bottom }),
    shape("text", { class: "limit-words", x: x + (early ? -4 : 4), y: MARGIN.top + 10, "text-anchor": early ? "end" : "start" }, inUnit(asked.budget)),
  );
}

function dot(plot, row, mass, shown, hue) {
  const [x, y] = [plot.toX(mass), plot.toY(shown(row))];
  const placed = row.place !== undefined;
  const kind = [placed ? (row.pareto ? "" : "behind") : "out", row.beyond || row.design.crossed ? "doubt" : "", row.place === 1 ? "best" : ""];
  if (row.error && row.value) {
    const share = row.error / Math.abs(row.value);
    const inside = (v) => Math.min(Math.max(v, MARGIN.top), plot.bottom);
    const [y1, y2] = [1 - share, 1 + share].map((k) => inside(plot.toY(shown(row) * Math.max(k, 0.1))));
    plot.svg.append(shape("line", { class: "bar", x1: x, x2: x, y1, y2 }));
  }
  plot.svg.append(
    shape("circle", {
      class: `dot ${kind.join(" ")}`,
      "data-dot": row.design.id,
      style: `color: var(${hue})`,
      cx: x,
      cy: y,
      r: row.place === 1 ? 7 : now.rows.length > MANY ? 3 : 5,
      onpointerenter: () => showCard(plot, row, x, y),
      onpointerleave: () => (($("card").hidden = true), near(row.design.id, false)),
      onclick: () => lookAt(row.design.id),
    }),
  );
  if (row.design.coarse) plot.svg.append(shape("text", { class: "sign", x: x + 7, y: y - 5 }, "i"));
}

function showCard(plot, row, x, y) {
  const { design } = row;
  const card = $("card");
  const out = (!now.refused && missText(row)) || (now.refused || row.value === null ? "not ranked" : "above the budget");
  const place = row.place === undefined ? out : `place ${placeText(row)}`;
  const values = `${digits(row.mass)} g, ${row.value === null ? "no value" : valueText(row) + percentOf(row)}`;
  card.replaceChildren(...drawn(design), element("p", {}, design.label), element("p", {}, `${values}; ${place}`));
  card.hidden = false;
  const left = x + 206 > plot.width ? x - 202 : x + 12;
  card.style.left = `${Math.max(left, 0)}px`;
  card.style.top = `${Math.max(Math.min(y - 40, plot.height - card.offsetHeight), 0)}px`;
  near(design.id, true);
}

// ---- chosen designs ----

function chosen() {
  const first = now.placed.length ? now.placed.slice(0, FIRST) : [now.nearest ?? []].flat();
  return view.chosen ?? first.map((row) => row.design.id);
}

function current() {
  return view.current ?? (now.placed[0] ?? now.nearest)?.design.id;
}

function designOf(id) {
  return data.cases.find((design) => design.id === id);
}

function choose(id, on) {
  const others = chosen().filter((other) => other !== id);
  view.chosen = on ? [...others, id].slice(-COLORS) : others;
  showTable();
  showCurves();
}

function lookAt(id) {
  view.current = id;
  if (!chosen().includes(id)) choose(id, true);
  showTable();
  showCurves();
  showOne();
}

function showCurves() {
  const designs = chosen().map(designOf).filter((design) => design?.curve?.[0].length);
  $("legend").replaceChildren(
    ...designs.map((design, i) =>
      element("button", { type: "button", class: design.id === current() ? "current" : null, onclick: () => lookAt(design.id) }, swatch(`--c${i}`), design.label),
    ),
  );
  view.mark = null;
  if (!designs.length) return $("curves").replaceChildren("No selected design has a curve.");
  const [x, y] = scene().axes;
  const plot = chart($("curves"), {
    x: { range: extent(designs.map((design) => design.curve[0])), label: x },
    y: { range: extent(designs.map((design) => design.curve[1])), label: y },
    label: `${y} over ${x}`,
  });
  designs.forEach((design, i) =>
    line(plot, ...design.curve, { style: `stroke: var(--c${i})`, "stroke-width": design.id === current() ? 2.8 : 1.6 }),
  );
  const share = (design) => asked.force / (ofPanel(asked) ? panelOf(asked.panel, design, data.beside).specimens : 1);
  for (const y of asked.force === null ? [] : new Set(designs.map((design) => plot.toY(share(design)))))
    if (y > MARGIN.top) plot.svg.append(shape("line", { class: "limit", x1: MARGIN.left, x2: plot.right, y1: y, y2: y }));
  const marker = shape("circle", { r: 5, fill: "var(--ink)", visibility: "hidden" });
  plot.svg.append(marker);
  view.mark = (strain, time, value) => {
    marker.setAttribute("visibility", value === null || strain === null ? "hidden" : "visible");
    marker.setAttribute("cx", plot.toX(x === "strain, %" ? (strain ?? 0) : time));
    marker.setAttribute("cy", plot.toY(value ?? 0));
  };
}

function swatch(color) {
  return element("span", { class: "swatch", style: `background: var(${color})` });
}

function showOne() {
  const design = designOf(current());
  stop();
  $("one").hidden = !design;
  if (!design) return;
  $("one-title").textContent = design.label;
  const said = [
    ...[`Case ${design.id}.`, design.message, design.slicer && `Slicer: ${design.slicer}.`],
    design.undrawn && `Does not print as drawn: ${design.undrawn}.`,
  ];
  $("one-words").textContent = said.filter(Boolean).join(" ");
  showStage(design);
  showBook(design);
  showBase(design);
  const drawn = data.drawings[design.drawing];
  $("download").hidden = !drawn;
  if (drawn) {
    URL.revokeObjectURL($("download").href);
    $("download").href = URL.createObjectURL(new Blob([drawingFile(drawn)], { type: "image/svg+xml" }));
    $("download").download = fileName(design, "svg");
  }
}

function showStage(design) {
  const moving = data.shapes[design.id];
  $("player").hidden = !moving;
  player = null;
  if (!moving) {
    const drawn = data.drawings[design.drawing];
    const words = element("p", { class: "quiet" }, "The page has no room for the motion of this design; crumple show draws it.");
    $("stage").replaceChildren(...(drawn ? [drawingOf(drawn, { style: "color: var(--wall)" })] : []), words);
    return;
  }
  player = { ...(moving.quads ? solidStage : stage)($("stage"), moving), moving };
  $("frame").max = player.frames - 1;
  showFrame(view.frame < player.frames && view.frame ? view.frame : Math.floor(player.frames / 3));
}

function showFrame(k) {
  const { moving } = player;
  view.frame = k;
  player.show(k);
  $("frame").value = k;
  const strain = moving.strain[k] === null ? `${moving.time[k]} ms` : `strain ${moving.strain[k].toFixed(moving.strain[k] < 10 ? 1 : 0)} %`;
  const force = moving.force[k] === null || scene().dead ? "" : `, ${digits(moving.force[k])} N`;
  $("caption").textContent = strain + force;
  view.mark?.(moving.strain[k], moving.time[k], moving.force[k]);
}

function play() {
  if (view.timer !== null) return stop();
  if (view.frame >= player.frames - 1) showFrame(0);
  $("play").textContent = "Pause";
  view.timer = setInterval(() => (view.frame < player.frames - 1 ? showFrame(view.frame + 1) : stop()), 1000 / PER_SECOND);
}

function stop() {
  clearInterval(view.timer);
  view.timer = null;
  $("play").textContent = "Play";
}

// The parts of the work, stacked from below, and the work itself as a line.
function showBook(design) {
  const { book } = design;
  $("book").replaceChildren();
  $("parts").replaceChildren();
  if (!book) return;
  const unit = energyUnit(Math.max(...book.values.slice(1).flat()));
  const [place, work, ...parts] = book.values.map((list, i) => (i ? list.map((v) => inUnits(v, unit)) : list));
  const sums = parts.reduce((rows, part) => [...rows, part.map((v, i) => v + rows[rows.length - 1][i])], [place.map(() => 0)]);
  const plot = chart($("book"), {
    x: { range: [place[0], place[place.length - 1]], label: book.label },
    y: { range: extent([work, ...sums]), label: `energy, ${unit}` },
    height: 340,
    label: "energies over the path",
  });
  sums.slice(1).forEach((sum, i) => {
    const back = [...sums[i]].reverse();
    line(plot, [...place, ...[...place].reverse()], [...sum, ...back], { style: `fill: var(--p${partColor(book.parts[i])})` });
  });
  line(plot, place, work, { style: "stroke: var(--ink)", "stroke-width": 1.6 });
  $("parts").replaceChildren(
    ...book.parts.map((name) => element("span", {}, swatch(`--p${partColor(name)}`), name)),
    element("span", {}, element("span", { class: "swatch", style: "background: var(--ink); height: 3px" }), book.total),
  );
}

// The greatest pressure on a patch of the base.
function showBase({ base }) {
  $("base").replaceChildren();
  if (!base) return;
  const [place, pressure] = base.values;
  const plot = chart($("base"), {
    x: { range: [place[0], place[place.length - 1]], label: base.label },
    y: { range: extent([pressure]), label: "base pressure, kPa" },
    height: 240,
    label: "pressure on the base over the path",
  });
  line(plot, place, pressure, { style: "stroke: var(--ink)", "stroke-width": 1.6 });
}

function partColor(name) {
  return data.parts.indexOf(name);
}

// ---- everything ----

// A link to the page opens with the question that is asked now.
function keepLink() {
  clearTimeout(linking);
  linking = setTimeout(() => {
    const link = `#${linkOf(asked, $("unit").value, data)}`;
    if (location.hash !== link) history.replaceState(null, "", link);
  }, LINKED);
}

function follow() {
  const { unit, ...question } = questionOf(location.hash.slice(1), data, asked) ?? {};
  Object.assign(asked, question);
  if ([...$("unit").options].some((option) => option.value === unit)) $("unit").value = unit;
  $("scene").value = asked.scene;
}

// A new scene has designs, curves and columns of its own.
function enter() {
  Object.assign(view, { chosen: null, current: null, sort: null });
  refresh();
}

function refresh() {
  settle();
  keepLink();
  now = ranked(data, asked);
  showAsked();
  showAnswer();
  showTable();
  notes();
  showMap();
  showCurves();
  showOne();
}

function start() {
  const { budgets_g: budgets, panel } = data.question;
  asked.budget = budgets.length ? budgets[Math.floor(budgets.length / 2)] : null;
  asked.panel = panel;
  asked.require = { ...data.question.require };
  asked.per = data.question.per;
  $("unit").value = unitOf(budgets);
  makeRequired();
  data.scenes.forEach(({ label }, i) => $("scene").append(element("option", { value: i }, label)));
  $("scenes").hidden = data.scenes.length < 2;
  $("scene").addEventListener("change", () => {
    asked.scene = Number($("scene").value);
    enter();
  });
  follow();
  window.addEventListener("hashchange", () => {
    follow();
    enter();
  });
  $("unit").addEventListener("change", refresh);
  $("panel-on").addEventListener("change", () => {
    asked.panel = $("panel-on").checked ? sidesOf() : null;
    refresh();
  });
  $("all").addEventListener("click", () => {
    view.all = !view.all;
    showTable();
  });
  $("play").addEventListener("click", play);
  $("frame").addEventListener("input", () => {
    stop();
    showFrame(Number($("frame").value));
  });
  $("app").hidden = false;
  refresh();
  $("static").remove();
  let width = window.innerWidth;
  window.addEventListener("resize", () => {
    if (window.innerWidth !== width) refresh();
    width = window.innerWidth;
  });
}

if (data.cases.length) start();
