// What every page does without its viewer: tables that fold, filter and become cards; contents that follow.
(() => {
  /** A table with more rows than this is folded. */
  const MOST = 12;

  /** The words of a cell of the head, its unit in brackets. */
  const words = (cell) => {
    const unit = cell.querySelector(".unit")?.textContent.trim();
    const own = [...cell.childNodes].filter((node) => !(node.classList?.contains("unit"))).map((node) => node.textContent);
    const name = own.join(" ").trim();
    return unit ? `${name} (${unit})` : name;
  };

  const made = (tag, attributes, ...children) => {
    const element = document.createElement(tag);
    for (const [name, value] of Object.entries(attributes)) {
      element.setAttribute(name, value);
    }
    element.append(...children);
    return element;
  };

  /** Cells that say what they are, and roles that stay when cells are drawn as cards. */
  const label = (table) => {
    const heads = [...(table.tHead?.rows[0]?.cells ?? [])].map(words);
    if (heads.length === 0) {
      return;
    }
    table.dataset.cards = "";
    table.setAttribute("role", "table");
    for (const group of [table.tHead, ...table.tBodies]) {
      group.setAttribute("role", "rowgroup");
      for (const row of group.rows) {
        row.setAttribute("role", "row");
        [...row.cells].forEach((cell, k) => {
          const head = group === table.tHead;
          cell.setAttribute("role", head ? "columnheader" : cell.tagName === "TH" ? "rowheader" : "cell");
          if (!head && cell.tagName === "TD" && heads[k]) {
            cell.dataset.label = heads[k];
          }
        });
      }
    }
  };

  /** Folds a long table and lets its rows be filtered. */
  const fold = (table) => {
    const rows = [...table.tBodies].flatMap((body) => [...body.rows]);
    if (rows.length <= MOST) {
      return;
    }
    const texts = rows.map((row) => row.textContent.toLowerCase());
    const field = made("input", { type: "search", autocomplete: "off" });
    const told = made("output", {});
    const button = made("button", { type: "button", "aria-expanded": "false" });
    let open = false;
    const show = () => {
      const wanted = field.value.toLowerCase().split(/\s+/).filter(Boolean);
      const found = rows.filter((_, k) => wanted.every((word) => texts[k].includes(word)));
      const seen = new Set(open || wanted.length > 0 ? found : found.slice(0, MOST));
      for (const row of rows) {
        row.hidden = !seen.has(row);
      }
      told.textContent = `${seen.size} of ${rows.length} rows`;
      button.hidden = wanted.length > 0;
      button.textContent = open ? "Show fewer" : "Show all";
      button.setAttribute("aria-expanded", String(open));
    };
    field.addEventListener("input", show);
    button.addEventListener("click", () => {
      open = !open;
      show();
    });
    const place = table.closest(".wide") ?? table;
    place.before(made("div", { class: "rows" }, made("label", {}, "Filter rows ", field), told, button));
    show();
    // A row that is linked to is shown.
    const follow = () => {
      const target = document.getElementById(decodeURIComponent(location.hash.slice(1)));
      if (target && table.contains(target) && target.closest("tr")?.hidden) {
        open = true;
        field.value = "";
        show();
        target.scrollIntoView();
      }
    };
    addEventListener("hashchange", follow);
    follow();
  };

  for (const table of document.querySelectorAll("main table")) {
    label(table);
    fold(table);
  }

  /** What is wider than its place can be scrolled with keys. */
  const reach = () => {
    for (const wide of document.querySelectorAll(".wide")) {
      const over = wide.scrollWidth > wide.clientWidth + 1;
      wide.toggleAttribute("tabindex", over);
      if (over) {
        wide.tabIndex = 0;
        wide.setAttribute("role", "region");
        const heading = wide.closest("section")?.querySelector("h2, h3");
        wide.setAttribute("aria-label", `Table: ${heading?.textContent ?? "numbers"}`);
      } else {
        wide.removeAttribute("role");
        wide.removeAttribute("aria-label");
      }
    }
  };
  // Sizes are asked for when all is there.
  addEventListener("load", reach);
  addEventListener("resize", reach);

  const contents = document.querySelector("nav details");
  if (contents) {
    const side = matchMedia("(min-width: 75rem)");
    const settle = () => (contents.open = side.matches);
    settle();
    side.addEventListener("change", settle);
    const links = new Map([...contents.querySelectorAll("a[href^='#']")].map((link) => [link.hash.slice(1), link]));
    const seen = new IntersectionObserver(
      (entries) => {
        for (const { target, isIntersecting } of entries) {
          if (isIntersecting) {
            for (const link of links.values()) {
              link.removeAttribute("aria-current");
            }
            links.get(target.id)?.setAttribute("aria-current", "location");
          }
        }
      },
      { rootMargin: "0px 0px -70% 0px" },
    );
    for (const id of links.keys()) {
      const heading = document.getElementById(id);
      if (heading) {
        seen.observe(heading);
      }
    }
  }
})();
