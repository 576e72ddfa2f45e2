// As much of a browser's document as `page.js` uses, for an engine that has none. An address (id) that the page
// does not have gives null, and a method that is missing here throws, as they should.

class Element {
  constructor(name) {
    Object.assign(this, { name, attributes: new Map(), children: [], parent: null, listeners: new Map() });
    Object.assign(this, { style: {}, value: "", checked: false, hidden: false, clientWidth: 600, offsetHeight: 100 });
    this.classList = { toggle: (word, on) => this.setAttribute("class", on ? word : "") };
    this.dataset = new Proxy(this, { get: (self, key) => self.attributes.get(`data-${key}`) });
  }
  setAttribute(name, value) {
    this.attributes.set(name, String(value));
    if (["value", "checked", "hidden"].includes(name)) this[name] = name === "value" ? value : true;
  }
  removeAttribute(name) {
    this.attributes.delete(name);
  }
  append(...children) {
    const nodes = children.map((child) => (child instanceof Element ? child : String(child)));
    for (const node of nodes) if (node instanceof Element) Object.assign(node, { parent: this });
    this.children.push(...nodes);
  }
  replaceChildren(...children) {
    this.children = [];
    this.append(...children);
  }
  remove() {
    this.parent.children = this.parent.children.filter((child) => child !== this);
  }
  addEventListener(event, listener) {
    this.listeners.set(event, listener);
  }
  dispatch(event) {
    this.listeners.get(event)({ target: this });
  }
  *[Symbol.iterator]() {
    yield this;
    for (const child of this.children) if (child instanceof Element) yield* child;
  }
  get textContent() {
    return this.children.map((child) => child.textContent ?? child).join("");
  }
  set textContent(text) {
    this.children = text === "" ? [] : [String(text)];
  }
  get options() {
    return [...this].filter(({ name }) => name === "option");
  }
  get tHead() {
    return [...this].find(({ name }) => name === "thead");
  }
  get tBodies() {
    return [...this].filter(({ name }) => name === "tbody");
  }
}

function built([name, attributes, children]) {
  const made = new Element(name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value ?? "");
  made.append(...children.map((child) => (typeof child === "string" ? child : built(child))));
  return made;
}

const window = { innerWidth: 1200, addEventListener() {} };
const location = { hash: "" };
const history = { replaceState: (state, title, link) => (location.hash = link) };
const URL = { createObjectURL: () => "blob:", revokeObjectURL() {} };
class Blob {}
class XMLSerializer {
  serializeToString(svg) {
    return `<${svg.name}/>`;
  }
}

const SIXTY_FOUR = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
function atob(text) {
  const bits = [...text.replace(/=+$/, "")].map((letter) => SIXTY_FOUR.indexOf(letter).toString(2).padStart(6, "0")).join("");
  return (bits.match(/.{8}/g) ?? []).map((byte) => String.fromCharCode(parseInt(byte, 2))).join("");
}

const timers = [];
const setInterval = (step) => timers.push(step) - 1;
const clearInterval = (number) => delete timers[number];
const document = {
  activeElement: null,
  createElement: (name) => new Element(name),
  createElementNS: (space, name) => new Element(name),
  getElementById: (id) => [...document.root].find((each) => each.attributes.get("id") === id) ?? null,
  querySelectorAll: (words) => {
    const [, name, value] = words.match(/^\[([\w-]+)="(.*)"\]$/);
    return [...document.root].filter((each) => each.attributes.get(name) === value);
  },
};
