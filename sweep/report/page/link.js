// The question of the page as the part of its address behind "#", so that a link keeps it.

const NONE = "none";
const positive = (value) => (value > 0 && Number.isFinite(value) ? value : null);

function linkOf({ scene, budget, panel, force, per, require }) {
  const words = { scene, budget: budget ?? NONE, panel: panel?.join("x") ?? NONE, force: force ?? NONE, per };
  return Object.entries({ ...words, ...require }).map(([name, value]) => `${name}=${value}`).join("&");
}

// The question of a link, without what it cannot mean; null if there is none.
function questionOf(link, data) {
  const words = new Map(link.split("&").map((word) => word.split("=", 2)));
  const scene = Number(words.get("scene") ?? NaN);
  if (data.scenes[scene] === undefined) return null;
  const sides = (words.get("panel") ?? "").split("x").map((side) => positive(Number(side)));
  const limits = Object.keys(data.measures).map((name) => [name, positive(Number(words.get(name)))]);
  return {
    scene,
    budget: positive(Number(words.get("budget"))), // in g
    panel: sides.length === 2 && sides.every((side) => side !== null) ? sides : null, // m
    force: positive(Number(words.get("force"))), // N
    per: words.get("per") === "panel" ? "panel" : "specimen",
    require: Object.fromEntries(limits.filter(([, limit]) => limit !== null)),
  };
}
