// Full-text search of the manual from any place, also from a disk; unfolding of all details for print.
(() => {
  "use strict";
  const box = document.getElementById("find");
  const list = document.getElementById("found");
  const most = 30;
  const around = 60;  // letters of the text before and after the first word found

  // Entries: [page, anchor, title, text]. The pages of a folder take them from search.js, when a reader first searches;
  // the single file makes them of its own sections.
  let index = null;
  const from_sections = () => {
    const sections = [...document.querySelectorAll("main > section")];
    const entries = [];
    sections.forEach((section, page) => {
      entries.push([page, section.id, section.querySelector("h1, h2").textContent, section.textContent]);
      for (const place of section.querySelectorAll("h3[id], h4[id], tr[id]"))
        entries.push([page, place.id, place.dataset.name ?? (place.cells?.[0] ?? place).textContent, place.textContent]);
    });
    return { pages: sections.map((section) => ["", section.querySelector("h1, h2").textContent, ""]), entries };
  };
  const prepare = (next) => {
    if (index) return next();
    const ready = (found) => {
      index = found;
      for (const entry of index.entries) entry.push((entry[2] + " " + entry[3]).toLowerCase());
      next();
    };
    if (!document.querySelector("link[rel=stylesheet]")) return ready(from_sections());
    const script = document.createElement("script");
    script.src = "search.js";
    script.onload = () => ready(window.voussoirManual);
    document.head.append(script);
  };

  const address = ([page, anchor]) => {
    const file = index.pages[page][0];
    if (!file) return "#" + anchor;
    const name = (file === "top" ? "index" : file) + ".html";
    return anchor === file ? name : name + "#" + anchor;
  };

  // the chapter, and the text about the first word, with all words marked
  const excerpt = (text, words, chapter) => {
    const at = Math.max(0, Math.min(...words.map((word) => text.toLowerCase().indexOf(word)).filter((k) => k >= 0), Infinity) - around);
    const piece = Number.isFinite(at) ? text.slice(at, at + 2 * around + words[0].length) : text.slice(0, 2 * around);
    const line = document.createElement("span");
    line.className = "quiet";
    if (chapter) line.append(chapter + ": ");
    let rest = piece;
    while (rest) {
      const lower = rest.toLowerCase();
      const hits = words.map((word) => [lower.indexOf(word), word]).filter(([k]) => k >= 0).sort((a, b) => a[0] - b[0]);
      if (!hits.length) break;
      const [k, word] = hits[0];
      const mark = document.createElement("mark");
      mark.textContent = rest.slice(k, k + word.length);
      line.append(rest.slice(0, k), mark);
      rest = rest.slice(k + word.length);
    }
    line.append(rest);
    return line;
  };

  const item = (...children) => {
    const element = document.createElement("li");
    element.append(...children);
    list.append(element);
  };

  // every word must occur; titles come before texts, short titles before long
  const find = () => {
    const words = box.value.toLowerCase().split(/\s+/).filter((word) => word);
    list.replaceChildren();
    if (!words.length) return;
    const titled = (entry) => words.filter((word) => entry[2].toLowerCase().includes(word)).length;
    const hits = index.entries.filter((entry) => words.every((word) => entry[4].includes(word)));
    hits.sort((a, b) => titled(b) - titled(a) || a[2].length - b[2].length);
    for (const hit of hits.slice(0, most)) {
      const link = document.createElement("a");
      link.href = address(hit);
      const [, page, chapter] = index.pages[hit[0]];
      link.textContent = hit[2] === page ? page : page + " › " + hit[2];
      item(link, excerpt(hit[3], words, chapter));
    }
    if (hits.length === 0 || hits.length > most) {
      const line = document.createElement("span");
      line.className = "quiet";
      line.textContent = hits.length ? hits.length - most + " more" : "nothing found";
      item(line);
    }
  };
  if (box) {
    box.addEventListener("input", () => prepare(find));
    box.addEventListener("keydown", (event) => {
      if (event.key === "Escape") box.value = "";
      if (event.key === "Enter" && list.querySelector("a")) list.querySelector("a").click();
      if (event.key === "Escape") prepare(find);
    });
    document.getElementById("finder").hidden = false;
  }
  // the page's own line of the list is in sight
  const here = document.querySelector("nav [aria-current]");
  const nav = here?.closest("nav");
  if (nav && nav.scrollHeight > nav.clientHeight) nav.scrollTop = here.offsetTop - nav.clientHeight / 3;

  // folded details are opened for print, and folded again
  let opened = [];
  window.addEventListener("beforeprint", () => {
    opened = [...document.querySelectorAll("details:not([open])")];
    for (const details of opened) details.open = true;
  });
  window.addEventListener("afterprint", () => {
    for (const details of opened) details.open = false;
  });
})();
