"use strict";
(() => {
  // What the contents show of the place one is at.
  const contents = document.querySelector(".contents");
  const links = [...contents.querySelectorAll("a[href^='#']")];
  const places = links.map(link => [link, document.getElementById(decodeURIComponent(link.hash.slice(1)))]).filter(pair => pair[1]);
  const narrow = matchMedia("(max-width: 69.99rem)");
  const fold = () => { contents.open = !narrow.matches; };
  narrow.addEventListener("change", fold);
  fold();
  links.forEach(link => link.addEventListener("click", () => { if (narrow.matches) contents.open = false; }));
  let waiting = false;
  const follow = () => {
    waiting = false;
    const passed = places.filter(([, place]) => place.getBoundingClientRect().top < 72);
    const [now] = passed.at(-1) || places[0] || [];
    if (!now || now.classList.contains("now")) return;
    links.forEach(link => { link.classList.toggle("now", link === now); link.removeAttribute("aria-current"); });
    now.setAttribute("aria-current", "true");
    contents.querySelectorAll("li").forEach(item => item.classList.toggle("open", item.contains(now)));
    if (!narrow.matches) now.scrollIntoView({ block: "nearest", behavior: "instant" });
  };
  addEventListener("scroll", () => { if (!waiting) { waiting = true; requestAnimationFrame(follow); } }, { passive: true });
  follow();

  // Tables: sorted by a column, and copied as a spreadsheet reads them.
  const value = cell => {
    const text = cell ? cell.dataset.value ?? cell.textContent.trim() : "";
    const number = Number.parseFloat(text.replace("−", "-"));
    return [Number.isFinite(number) && /^[-−+]?[\d.]/.test(text) ? number : null, text];
  };
  const sort = (table, column, head) => {
    const down = head.getAttribute("aria-sort") === "ascending";
    table.querySelectorAll("th[aria-sort]").forEach(other => other.removeAttribute("aria-sort"));
    head.setAttribute("aria-sort", down ? "descending" : "ascending");
    const rows = [...table.tBodies[0].rows].filter(row => row !== head.parentElement);
    const keyed = rows.map(row => [value(row.cells[column]), row]);
    keyed.sort(([[a, one]], [[b, other]]) => {
      // What has no number stays below, whichever way.
      if ((a === null) !== (b === null)) return a === null ? 1 : -1;
      const order = a === null ? one.localeCompare(other) : a - b;
      return down ? -order : order;
    });
    keyed.forEach(([, row]) => row.parentElement.append(row));
  };
  document.querySelectorAll("table.sortable").forEach(table => {
    [...table.rows[0].cells].forEach((head, column) => {
      const button = document.createElement("button");
      button.type = "button";
      button.title = "sort by this column";
      // A term in the head stays a link to its meaning, beside the button.
      button.append(...[...head.childNodes]);
      head.append(button);
      button.addEventListener("click", event => { event.preventDefault(); sort(table, column, head); });
    });
  });
  const copied = text => {
    const area = document.createElement("textarea");
    area.value = text;
    document.body.append(area);
    area.select();
    const done = document.execCommand("copy");
    area.remove();
    return done;
  };
  document.querySelectorAll(".scroll > table").forEach(table => {
    const button = document.createElement("button");
    button.type = "button";
    button.className = "copy";
    button.textContent = "copy table";
    button.addEventListener("click", () => {
      const text = [...table.rows].map(row => [...row.cells].map(cell => cell.textContent.trim().replace(/\s+/g, " ")).join("\t")).join("\n");
      button.textContent = copied(text) ? "copied" : "not copied: the browser refused";
      setTimeout(() => { button.textContent = "copy table"; }, 2000);
    });
    table.parentElement.after(button);
  });

  // The meaning of a term, where the pointer or the keyboard is on it.
  const box = document.createElement("div");
  box.id = "meaning";
  box.role = "tooltip";
  box.hidden = true;
  document.body.append(box);
  const tell = term => {
    box.textContent = term.dataset.meaning;
    box.hidden = false;
    const place = term.getBoundingClientRect();
    const left = Math.max(8, Math.min(place.left, document.documentElement.clientWidth - box.offsetWidth - 8));
    const below = place.bottom + box.offsetHeight + 8 < innerHeight;
    box.style.left = `${left + scrollX}px`;
    box.style.top = `${scrollY + (below ? place.bottom + 6 : place.top - box.offsetHeight - 6)}px`;
    term.setAttribute("aria-describedby", "meaning");
  };
  const hide = () => { box.hidden = true; };
  document.querySelectorAll(".term").forEach(term => {
    term.addEventListener("pointerenter", () => tell(term));
    term.addEventListener("focus", () => tell(term));
    term.addEventListener("pointerleave", hide);
    term.addEventListener("blur", hide);
    // In the head of a table a click sorts; the meaning is told all the same.
    if (term.closest("th button")) term.addEventListener("click", event => event.preventDefault());
  });
  addEventListener("keydown", event => { if (event.key === "Escape") hide(); });

  // On paper all that is folded is open.
  addEventListener("beforeprint", () => document.querySelectorAll("main details").forEach(part => { part.open = true; }));
})();
