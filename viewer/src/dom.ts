// Making elements.

type Attributes = Record<string, string | number | boolean | ((event: Event) => void)>;

/** An element with attributes, listeners (`onclick`) and children. */
export function element<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Attributes = {},
  ...children: (Node | string)[]
): HTMLElementTagNameMap[K] {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") {
      made.addEventListener(name.replace(/^on/, ""), value);
    } else if (typeof value === "boolean") {
      made.toggleAttribute(name, value);
    } else {
      made.setAttribute(name, String(value));
    }
  }
  made.append(...children);
  return made;
}

const SPACE = "http://www.w3.org/2000/svg";

/** A small picture of one path on a field of 16 by 16. */
export function icon(path: string): SVGSVGElement {
  const picture = document.createElementNS(SPACE, "svg");
  picture.setAttribute("viewBox", "0 0 16 16");
  picture.setAttribute("width", "16");
  picture.setAttribute("height", "16");
  picture.setAttribute("aria-hidden", "true");
  const line = document.createElementNS(SPACE, "path");
  line.setAttribute("d", path);
  line.setAttribute("fill", "currentColor");
  picture.append(line);
  return picture;
}

/** A list to choose from. */
export function select(
  attributes: Attributes,
  options: [string, string][],
  chosen: string,
  onchange: (value: string) => void,
): HTMLSelectElement {
  const made = element(
    "select",
    attributes,
    ...options.map(([value, text]) => element("option", { value, selected: value === chosen }, text)),
  );
  made.addEventListener("change", () => onchange(made.value));
  return made;
}
