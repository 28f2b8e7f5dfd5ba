// SPDX-License-Identifier: Apache-2.0
// Comfort only: without it the page is complete. The filter lives in the fragment of the address
// (#?q=1003h&v=fail,warn), so that a view can be sent to somebody else.
(function () {
  "use strict";
  var root = document.documentElement;
  function all(selector, from) { return Array.prototype.slice.call((from || document).querySelectorAll(selector)); }
  function by(id) { return document.getElementById(id); }

  // ---- light and dark: what the system says, until the reader says otherwise ----
  var theme = by("theme");
  var dark = window.matchMedia("(prefers-color-scheme: dark)");
  function isDark() { return root.dataset.theme ? root.dataset.theme === "dark" : dark.matches; }
  function nameTheme() { theme.textContent = isDark() ? "Light" : "Dark"; }
  theme.addEventListener("click", function () { root.dataset.theme = isDark() ? "light" : "dark"; nameTheme(); });
  dark.addEventListener("change", nameTheme);
  theme.hidden = false;
  nameTheme();

  // ---- filter ----
  var form = by("filter"), q = by("q"), shown = by("shown");
  var boxes = all("input[name=v]", form);
  // The lists of the page, the last one first: it is the one with the most detail. What is shown a second time
  // follows the filter and is not counted.
  var lists = all("[data-rows]").reverse().map(function (list) {
    var rows = all("[data-v]", list).map(function (e) { return { element: e, again: e.closest("[data-again]") !== null }; });
    return {
      one: list.dataset.row, many: list.dataset.rows, rows: rows,
      total: rows.filter(function (row) { return !row.again; }).length,
      isLong: list.querySelector(".rows") !== null
    };
  });
  // Lists first: a group is empty when its lists are.
  var groups = all("[data-rows] .rows").concat(all("[data-rows] .group"));
  // A long table is folded; what is looked for in it is shown.
  var tables = all("#dictionary details").map(function (e) { return { element: e, opened: false }; });
  var few = 400;

  function textOf(entry) {
    if (entry.text === undefined) {
      var group = entry.element.closest(".group");
      var title = group && group.querySelector("h3");
      var heading = title ? title.textContent : "";
      entry.text = (heading + "/" + entry.element.textContent).toLowerCase();
    }
    return entry.text;
  }
  function hide(element, hidden) { if (element.hidden !== hidden) element.hidden = hidden; }
  function wanted() {
    return {
      words: q.value.toLowerCase().split(/\s+/).filter(Boolean),
      verdicts: boxes.filter(function (b) { return b.checked; }).map(function (b) { return b.value; })
    };
  }
  function apply() {
    var want = wanted();
    var counts = [], rows = 0;
    lists.forEach(function (list) {
      var visible = 0;
      list.rows.forEach(function (entry) {
        var fits = !want.verdicts.length || want.verdicts.indexOf(entry.element.dataset.v) >= 0;
        fits = fits && want.words.every(function (word) { return textOf(entry).indexOf(word) >= 0; });
        hide(entry.element, !fits);
        if (fits && !entry.again) visible += 1;
      });
      if (list.isLong) rows += visible;
      if (list.total) counts.push(visible + " of " + list.total + " " + (list.total === 1 ? list.one : list.many));
    });
    // So many are laid out at once: the page then has its true length.
    var main = document.querySelector("main");
    main.classList.toggle("narrowed", rows < few);
    groups.forEach(function (group) { hide(group, !group.querySelector("[data-v]:not([hidden])")); });
    var active = want.words.length || want.verdicts.length;
    // Whoever has chosen gets on paper what is on the screen.
    main.classList.toggle("chosen", Boolean(active));
    tables.forEach(function (table) {
      var open = Boolean(active) && table.element.querySelectorAll("tr[data-v]:not([hidden])").length < few;
      if (open && !table.element.open) { table.element.open = true; table.opened = true; }
      if (!open && table.opened) { table.element.open = false; table.opened = false; }
    });
    shown.textContent = active ? counts.join(", ") : "";
  }
  function fragment() {
    var parts = [];
    if (q.value) parts.push("q=" + encodeURIComponent(q.value));
    var verdicts = wanted().verdicts;
    if (verdicts.length) parts.push("v=" + verdicts.join(","));
    return parts.length ? "#?" + parts.join("&") : "#";
  }
  function remember() {
    // A page that a mail program shows may have no history of its own.
    try { history.replaceState(null, "", fragment()); } catch (ignored) { return; }
  }
  function read() {
    var state = { q: "", v: "" };
    location.hash.slice(2).split("&").forEach(function (part) {
      var at = part.indexOf("=");
      if (at < 0) return;
      try { state[part.slice(0, at)] = decodeURIComponent(part.slice(at + 1)); } catch (ignored) { return; }
    });
    q.value = state.q;
    boxes.forEach(function (box) { box.checked = state.v.split(",").indexOf(box.value) >= 0; });
  }
  var timer = 0;
  function changed() { apply(); remember(); }
  form.addEventListener("input", function () { clearTimeout(timer); timer = setTimeout(changed, 80); });
  form.addEventListener("submit", function (event) { event.preventDefault(); changed(); });
  form.addEventListener("reset", function () { setTimeout(changed, 0); });
  document.addEventListener("keydown", function (event) {
    var typing = /^(INPUT|TEXTAREA|SELECT)$/.test(event.target.tagName);
    if (event.key === "/" && !typing && !event.ctrlKey && !event.metaKey && !event.altKey) { event.preventDefault(); q.focus(); }
    if (event.key === "Escape" && event.target === q && q.value) { q.value = ""; changed(); }
  });
  form.hidden = false;

  // ---- links inside the page: what they lead to is shown, whatever is filtered or folded ----
  function go() {
    if (location.hash.slice(0, 2) === "#?") { read(); apply(); return; }
    var target = location.hash.length > 1 ? by(decodeURIComponent(location.hash.slice(1))) : null;
    if (!target) return;
    if (target.closest("[hidden]")) { q.value = ""; boxes.forEach(function (box) { box.checked = false; }); apply(); }
    for (var e = target; e; e = e.parentElement) { if (e.tagName === "DETAILS") e.open = true; }
    target.scrollIntoView();
  }
  window.addEventListener("hashchange", go);
  if (location.hash.length > 1) go();

  // ---- paper shows what is folded, too ----
  var folded = [];
  window.addEventListener("beforeprint", function () {
    folded = all("details:not([open])");
    folded.forEach(function (d) { d.open = true; });
  });
  window.addEventListener("afterprint", function () { folded.forEach(function (d) { d.open = false; }); });

  // ---- commands to copy ----
  if (navigator.clipboard) {
    all("code.copy").forEach(function (command) {
      var button = document.createElement("button");
      button.type = "button";
      button.className = "copied";
      button.textContent = "Copy";
      button.setAttribute("aria-label", "Copy the command");
      button.addEventListener("click", function () {
        navigator.clipboard.writeText(command.textContent).then(function () {
          button.textContent = "Copied";
          setTimeout(function () { button.textContent = "Copy"; }, 1500);
        });
      });
      command.after(button);
    });
  }
}());
