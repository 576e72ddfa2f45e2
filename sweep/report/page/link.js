// The question of the page as the part of its address behind "#", so that a link keeps it.

const NONE = "none";

function linkOf({ scene, budget, panel, force, per, require }, unit, data) {
  const words = { scene: data.scenes[scene].label, budget: budget ?? NONE, unit, panel: panel?.join("x") ?? NONE, force: force ?? NONE, per };
  return Object.entries({ ...words, ...require }).map(([name, value]) => `${name}=${encodeURIComponent(value)}`).join("&");
}

function decoded(text) {
  try {
    return decodeURIComponent(text);
  } catch {
    return text; // a lone per cent sign
  }
}

// The question of a link, and the unit of its budget. What the link does not say, or what cannot be,
// is as in `usual`; null if it names no scene of the page.
function questionOf(link, data, usual) {
  const words = new Map(link.split("&").map((word) => word.split("=", 2).map(decoded)));
  const scene = data.scenes.findIndex(({ label }) => label === words.get("scene"));
  if (scene < 0) return null;
  const number = (text) => (/^[\d.]+(e[-+]?\d+)?$/.test(text ?? "") && Number(text) > 0 && Number(text) < Infinity ? Number(text) : null);
  const sides = (text) => {
    const both = (text ?? "").split("x").map(number);
    return both.length === 2 && both.every((side) => side !== null && side <= 100) ? both : null;
  };
  const said = (name, read) => (words.get(name) === NONE ? null : (read(words.get(name)) ?? usual[name]));
  const limits = Object.keys(data.measures).map((name) => [name, number(words.get(name))]);
  const isWhole = ["panel", "specimen"].includes(words.get("per")); // it says what is required
  return {
    scene,
    budget: said("budget", number), // g
    unit: words.get("unit"),
    panel: said("panel", sides), // m
    force: said("force", number), // N
    per: isWhole ? words.get("per") : usual.per,
    require: isWhole ? Object.fromEntries(limits.filter(([, limit]) => limit !== null)) : usual.require,
  };
}
