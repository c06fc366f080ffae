// What the tests of all pages ask of what is seen.
/* global getComputedStyle, NodeFilter */

/** Of a phone, a notebook and a large screen, px. */
export const WIDTHS = [390, 1366, 1920];

/** What is too wide: the page, tables beside cards and figures. */
export const tooWide = (page) =>
  page.evaluate(() => {
    const width = document.documentElement.clientWidth;
    const found = document.documentElement.scrollWidth > width ? [`the page: ${document.documentElement.scrollWidth} px`] : [];
    for (const element of document.querySelectorAll("main *, nav *, header *")) {
      const { left, right, width: own } = element.getBoundingClientRect();
      const scrolled = element.closest(".wide") !== null && element.closest(".wide") !== element;
      if (own > 0 && !scrolled && (right > width + 1 || left < -1) && !element.closest(".wl-names, .u-over, svg, .uplot, thead")) {
        found.push(`${element.tagName} ${element.className}: ${left.toFixed(0)} to ${right.toFixed(0)}`);
      }
    }
    for (const wide of document.querySelectorAll(".wide")) {
      if (wide.scrollWidth > wide.clientWidth + 1) {
        found.push(`table below "${wide.closest("section")?.querySelector("h2")?.textContent}": ${wide.scrollWidth} in ${wide.clientWidth}`);
      }
    }
    return found.slice(0, 8);
  });

/** What a page consists of, which is what a browser is busy with. */
export const parts = (page) =>
  page.evaluate(() => ({ elements: document.querySelectorAll("*").length, canvases: document.querySelectorAll("canvas").length }));

/** Texts whose contrast with what is behind them is below WCAG AA. */
export const faint = (page) =>
  page.evaluate(() => {
    const parse = (text) => {
      const numbers = text.match(/-?[\d.]+(e-?\d+)?/g)?.map(Number) ?? [0, 0, 0, 0];
      const [r, g, b, a = 1] = numbers;
      return text.startsWith("color(") ? [255 * r, 255 * g, 255 * b, a] : [r, g, b, a];
    };
    const over = ([r, g, b, a], under) => [r, g, b].map((part, k) => a * part + (1 - a) * under[k]);
    const behind = (element) => {
      if (!element) {
        return [255, 255, 255];
      }
      const own = parse(getComputedStyle(element).backgroundColor);
      return own[3] >= 1 ? own.slice(0, 3) : over(own, behind(element.parentElement));
    };
    const light = (rgb) => {
      const [r, g, b] = rgb.map((part) => (part / 255 <= 0.04045 ? part / 255 / 12.92 : ((part / 255 + 0.055) / 1.055) ** 2.4));
      return 0.2126 * r + 0.7152 * g + 0.0722 * b;
    };
    const found = [];
    let texts = 0;
    const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
    for (let node = walker.nextNode(); node; node = walker.nextNode()) {
      const element = node.parentElement;
      if (!node.textContent.trim() || element.closest("svg, script, style, option") || !element.checkVisibility()) {
        continue;
      }
      const style = getComputedStyle(element);
      const under = behind(element);
      const [a, b] = [light(over(parse(style.color), under)), light(under)].sort((x, y) => y - x);
      const ratio = (a + 0.05) / (b + 0.05);
      const size = parseFloat(style.fontSize);
      const large = size >= 24 || (size >= 18.66 && Number(style.fontWeight) >= 700);
      texts++;
      if (ratio < (large ? 3 : 4.5)) {
        found.push(`${ratio.toFixed(2)} ${element.tagName}.${element.className}: ${node.textContent.trim().slice(0, 40)}`);
      }
    }
    return { texts, found: found.slice(0, 8) };
  });
