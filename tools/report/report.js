"use strict";
// Tables that sort, and error charts that can be read and zoomed. Without it all is there as text.
(() => {
  /** Empty cells come last either way. */
  function compare(a, b, down) {
    if (a === "" || b === "") return (a === "") - (b === "");
    const numeric = Number.isFinite(Number(a)) && Number.isFinite(Number(b));
    const order = numeric ? Number(a) - Number(b) : a.localeCompare(b);
    return down ? -order : order;
  }

  function sort(table, column, header) {
    const down = header.getAttribute("aria-sort") === "ascending";
    for (const other of table.tHead.rows[0].cells) other.removeAttribute("aria-sort");
    header.setAttribute("aria-sort", down ? "descending" : "ascending");
    const key = (row) => row.cells[column].dataset.sort ?? row.cells[column].textContent.trim();
    const rows = [...table.tBodies[0].rows];
    rows.sort((a, b) => compare(key(a), key(b), down));
    table.tBodies[0].append(...rows);
  }

  for (const table of document.querySelectorAll("table.sortable")) {
    [...table.tHead.rows[0].cells].forEach((header, column) => {
      const button = document.createElement("button");
      button.type = "button";
      button.append(...header.childNodes);
      button.addEventListener("click", () => sort(table, column, header));
      header.append(button);
    });
  }

  // Names are shown as text only, under the chart; and the legend of the library writes style
  // attributes, which the page's policy forbids.
  Dygraph.PLUGINS = Dygraph.PLUGINS.filter((plugin) => plugin !== Dygraph.Plugins.Legend);

  const colour = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();
  const appearance = (data) => ({
    colors: data.colours.map((n) => colour(`--series-${n}`)),
    gridLineColor: colour("--grid"),
    axisLineColor: colour("--line"),
  });

  function enhance(figure) {
    const data = JSON.parse(figure.querySelector("script").textContent);
    if (data.rows.length < 2) return;
    const live = document.createElement("div");
    live.className = "live-chart";
    figure.querySelector("figcaption").before(live);
    figure.classList.add("enhanced");
    const reading = document.createElement("p");
    reading.className = "reading";
    figure.append(reading);
    const columns = data.labels.map((label, i) => `${i}`);
    const graph = new Dygraph(live, data.rows, {
      labels: ["t", ...columns],
      customBars: true,
      logscale: true,
      strokeWidth: 2,
      fillAlpha: 0.14,
      axes: { x: { axisLabelFormatter: (t) => `${+t.toPrecision(4)} s` },
        y: { axisLabelWidth: 58, axisLabelFormatter: (error) => `${+error.toPrecision(3)} m` } },
      ...appearance(data),
      highlightCallback: (event, t, points) => {
        const values = points.map((point) =>
          `${data.labels[Number(point.name)]} ${point.yval.toPrecision(3)} m`);
        reading.textContent = `At ${t.toPrecision(3)} s: ${values.join(", ")}.`;
      },
      unhighlightCallback: () => { reading.textContent = ""; },
    });
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change",
      () => graph.updateOptions(appearance(data)));
  }

  // A figure by itself, as it looks on paper: what the page's style says of it is written into it.
  const drawn = ["fill", "stroke", "stroke-width", "stroke-dasharray", "stroke-linecap",
    "stroke-linejoin", "opacity", "font-size", "text-anchor"];
  function standing(svg) {
    const copy = svg.cloneNode(true);
    const originals = [svg, ...svg.querySelectorAll("*")];
    [copy, ...copy.querySelectorAll("*")].forEach((element, i) => {
      const style = getComputedStyle(originals[i]);
      for (const name of drawn) element.setAttribute(name, style.getPropertyValue(name));
      element.removeAttribute("class");
    });
    copy.setAttribute("xmlns", "http://www.w3.org/2000/svg");
    copy.setAttribute("font-family", "sans-serif");
    const [, , width, height] = svg.getAttribute("viewBox").split(" ");
    copy.setAttribute("width", width);
    copy.setAttribute("height", height);
    return new XMLSerializer().serializeToString(copy);
  }
  for (const figure of document.querySelectorAll("figure")) {
    const svg = figure.querySelector("svg.chart"), heading = figure.querySelector("h3");
    if (!svg || !heading) continue;
    const section = figure.closest("section")?.querySelector("h2")?.textContent ?? "";
    const link = document.createElement("a");
    link.className = "download";
    link.textContent = "SVG";
    link.setAttribute("aria-label", `${heading.textContent} as SVG`);
    link.download = `${section} ${heading.textContent}`.replace(/[^A-Za-z0-9.=-]+/g, "_") + ".svg";
    link.href = "#";
    const prepare = () => {
      figure.classList.remove("enhanced");  // what is not shown has no style
      link.href = "data:image/svg+xml," + encodeURIComponent(standing(svg));
      figure.classList.toggle("enhanced", figure.querySelector(".live-chart") !== null);
    };
    link.addEventListener("pointerenter", prepare);
    link.addEventListener("focus", prepare);
    link.addEventListener("click", prepare);
    heading.append(link);
  }

  // Charts are made when they come near the window: a report may have a hundred.
  const near = new IntersectionObserver((entries) => {
    for (const entry of entries.filter((candidate) => candidate.isIntersecting)) {
      near.unobserve(entry.target);
      enhance(entry.target);
    }
  }, { rootMargin: "600px" });
  for (const figure of document.querySelectorAll(".error-chart")) near.observe(figure);
})();
