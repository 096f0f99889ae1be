// Search for a case, key or equation by name, and unfolding of all details for print.
(() => {
  "use strict";
  const finder = document.getElementById("finder");
  const box = document.getElementById("find");
  const list = document.getElementById("found");
  const most = 40;

  // entries that can be found: place, name, and name of the kind
  const places = [];
  const add = (element, name, kind, besides = "") => {
    if (!element.id) element.id = "place-" + places.length;
    const text = [name, besides, element.textContent].join(" ").toLowerCase();
    places.push({ id: element.id, name: name.trim(), kind, text });
  };
  for (const section of document.querySelectorAll("main > section")) {
    const title = section.querySelector("h2");
    if (!title) continue;
    const name = section.querySelector(".case-name");
    add(title, name ? name.textContent + ": " + title.textContent : title.textContent, name ? "case" : "page");
  }
  // a key belongs to the tables that the heading above it names, and is found as table.key too
  let tables = [];
  for (const element of document.querySelectorAll("#scene-keys h3, #scene-keys tbody tr")) {
    if (element.tagName === "H3") {
      tables = [...element.querySelectorAll("code")].map((code) => code.textContent.replace(/[[\]]/g, ""));
      continue;
    }
    const key = element.querySelector("td code");
    if (!key) continue;
    const name = tables.length ? tables[0] + "." + key.textContent : key.textContent;
    add(element, name, "key", tables.map((table) => table + "." + key.textContent).join(" "));
  }
  for (const row of document.querySelectorAll("table.equations tbody tr")) {
    const cells = row.querySelectorAll("td");
    add(row, "Eq. " + cells[0].textContent + " " + cells[1].firstChild.textContent, "equation");
  }

  // every word must occur; names come before texts, short names before long
  const find = () => {
    const words = box.value.toLowerCase().split(/\s+/).filter((word) => word);
    list.replaceChildren();
    if (!words.length) return;
    const named = (place) => words.every((word) => place.name.toLowerCase().includes(word));
    const hits = places.filter((place) => words.every((word) => place.text.includes(word)));
    hits.sort((a, b) => named(b) - named(a) || a.name.length - b.name.length);
    for (const place of hits.slice(0, most)) {
      const link = document.createElement("a");
      link.href = "#" + place.id;
      link.textContent = place.name;
      const kind = document.createElement("span");
      kind.className = "quiet";
      kind.textContent = " " + place.kind;
      const item = document.createElement("li");
      item.append(link, kind);
      list.append(item);
    }
    if (hits.length === 0 || hits.length > most) {
      const item = document.createElement("li");
      item.className = "quiet";
      item.textContent = hits.length ? hits.length - most + " more" : "nothing found";
      list.append(item);
    }
  };
  box.addEventListener("input", find);
  box.addEventListener("keydown", (event) => {
    if (event.key === "Escape") box.value = "";
    if (event.key === "Enter" && list.querySelector("a")) list.querySelector("a").click();
    if (event.key === "Escape") find();
  });
  finder.hidden = false;

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
