"use strict";
// Sliders and lists that change the setting: the sensors, and one tracker or two.

/** A value as a scene says it: {ghk: {g: 0.5, h: 0.2}}. */
lab.flow = (value) => {
  if (Array.isArray(value)) return `[${value.map(lab.flow).join(", ")}]`;
  if (value !== null && typeof value === "object") {
    return `{${Object.entries(value).map(([key, item]) => `${lab.word(key)}: ${lab.flow(item)}`).join(", ")}}`;
  }
  return typeof value === "string" ? lab.word(value) : String(value);
};
lab.word = (text) => /^[A-Za-z][\w.-]*( [\w.-]+)*$/.test(text) &&
  !/^(true|false|null|yes|no|on|off|y|n)$/i.test(text) ? text : JSON.stringify(text);

lab.copy = (value) => value === undefined ? undefined : JSON.parse(JSON.stringify(value));
lab.same = (a, b) => JSON.stringify(a) === JSON.stringify(b);

/** A key of a scene as people say it. */
lab.spoken = (key) => ({ theta: "θ", x0: "first guess", dx0: "guess of the rate", ddx0: "guess of the acceleration",
  p0: "variance of the guess", q: "variance of a step", r: "variance of a measurement", u: "movement" })[key] ?? key.replaceAll("_", " ");

lab.option = (value, text) => {
  const option = document.createElement("option");
  option.value = value;
  option.textContent = text ?? value;
  return option;
};

/** What a slider's place means: even steps, finer towards the lower end, or by factors. */
lab.scales = {
  even: { to: (share, low, high) => low + share * (high - low), from: (v, low, high) => (v - low) / (high - low) },
  fine: { to: (share, low, high) => low + share * share * (high - low), from: (v, low, high) => Math.sqrt(Math.max(0, v - low) / (high - low)) },
  factors: { to: (share, low, high) => low * (high / low) ** share, from: (v, low, high) => Math.log(Math.max(v, low) / low) / Math.log(high / low) },
};

/** A labelled slider. onInput gets the new value, rounded to three digits or to a whole number. */
lab.slider = ({ id, label, meaning, unit, low, high, scale, value, whole, onInput }) => {
  const row = document.createElement("div");
  row.className = "lab-slider";
  const name = document.createElement("label");
  name.htmlFor = id;
  const bold = document.createElement("b");
  bold.textContent = label;
  name.append(bold, meaning ? ` ${meaning}` : "");
  const output = document.createElement("output");
  output.htmlFor = id;
  const input = document.createElement("input");
  Object.assign(input, { type: "range", id, min: 0, max: 1000, step: 1 });
  const { to, from } = lab.scales[scale];
  const show = (v) => {
    output.textContent = `${lab.short(v)}${unit && unit !== "1" ? ` ${unit}` : ""}`;
    input.setAttribute("aria-valuetext", output.textContent);
  };
  input.value = Math.round(1000 * Math.min(1, Math.max(0, from(value, low, high))));
  show(value);
  input.addEventListener("input", () => {
    const turned = to(input.value / 1000, low, high);
    const v = whole ? Math.round(turned) : Number(turned.toPrecision(3));
    show(v);
    onInput(v);
  });
  row.append(name, output, input);
  return row;
};

/** Range and scale of a number of a filter: its bounds, or what is usual. */
lab.rangeOf = (number, value) => {
  const usual = { g: [0.001, 2, "fine"], h: [0.0001, 4, "fine"], k: [0, 1, "fine"], theta: [0, 0.999, "even"],
    switching: [0, 0.5, "fine"], n: [2, 40, "even"] };
  if (usual[number.key]) return usual[number.key];
  const reference = Math.abs(value) || Math.abs(number.default) || 1;
  if (number.minimum !== null && number.maximum !== null && number.maximum - number.minimum <= 10) {
    return [number.minimum, number.maximum, "even"];
  }
  return [reference / 100, reference * 100, "factors"];
};

lab.Controls = class {
  /** @param onChange  called after each change of the setting */
  constructor(scene, onChange) {
    this.scene = scene;
    this.onChange = onChange;
    this.forms = new Map(scene.forms.map((form) => [form.kind, form]));
    this.reset();
    this.listen();
  }

  reset() {
    this.sensors = lab.copy(this.scene.sensors);
    this.trackers = [lab.copy(this.scene.tracker)];
    this.trackers[0].filters ??= {};
    this.side = 0;
    const classes = Object.keys(this.trackers[0].filters);
    this.chosenClass = classes.find((name) => name !== "default") ?? "default";
    this.show();
  }

  /** A filter to begin with: what has to be said, and nothing else. */
  usual(kind, way) {
    const form = this.forms.get(kind), values = {};
    if (way !== undefined) values[form.way] = way;
    const chosen = form.ways?.find((one) => one.kind === (way ?? form.default_way));
    for (const { key, required, default: value } of [...chosen?.numbers ?? [], ...form.numbers]) {
      const usual = { g: 0.4, h: 0.1, k: 0.01, theta: 0.8, n: 10 };
      if (required) values[key] = usual[key] ?? (value || 1);
    }
    if (kind === "multiple-model") {
      values.filters = { steady: { "kalman-cv": { process_noise: 1 } }, nimble: { "kalman-cv": { process_noise: 30 } } };
    }
    return values;
  }

  get tracker() { return this.trackers[this.side]; }
  /** The filter that is turned: {kind: {…}}. */
  get filter() { return this.tracker.filters[this.chosenClass] ?? { gh: {} }; }
  set filter(filter) { this.tracker.filters[this.chosenClass] = filter; }

  /** What C++ reads. */
  setting() {
    return JSON.stringify({ sensors: this.sensors, tracker: this.trackers[0], other: this.trackers[1] });
  }

  /** The command that does the same, for one of the trackers. */
  command(which) {
    const changes = [];
    const before = this.scene.tracker, tracker = this.trackers[which];
    for (const key of Object.keys(tracker)) {
      if (key === "filters") continue;
      if (!lab.same(tracker[key], before[key])) changes.push([`tracker.${key}`, tracker[key]]);
    }
    const old = before.filters ?? {};
    if (Object.keys(old).some((name) => !(name in tracker.filters))) {
      changes.push(["tracker.filters", tracker.filters]);
    } else {
      for (const [name, filter] of Object.entries(tracker.filters)) {
        if (!lab.same(filter, old[name])) changes.push([`tracker.filters.${name}`, filter]);
      }
    }
    this.sensors.forEach((sensor, i) => {
      for (const [key, value] of Object.entries(sensor)) {
        if (!lab.same(value, this.scene.sensors[i][key])) changes.push([`sensors[${i}].${key}`, value]);
      }
    });
    const quoted = (text) => `'${text.replaceAll("'", "'\\''")}'`;
    return [this.scene.command, ...changes.map(([key, value]) => `--set ${quoted(`${key}=${lab.flow(value)}`)}`)].join(" ");
  }

  changed() { this.onChange(); }

  /** Fills everything in anew. */
  show() {
    this.showCompared();
    this.showClasses();
    this.showFilter();
    this.showSensors();
    this.showTracker();
  }

  showCompared() {
    const list = lab.byId("lab-compare");
    if (list.options.length === 0) {
      list.append(lab.option("", "nothing"), lab.option("copy", "a copy, to be turned"));
      for (const name of Object.keys(this.scene.compare)) list.append(lab.option(`filter ${name}`, `${name} for all`));
    }
    if (!this.trackers[1]) list.value = "";
    const sides = lab.byId("lab-sides");
    sides.hidden = !this.trackers[1];
    for (const button of sides.children) button.setAttribute("aria-pressed", Number(button.dataset.side) === this.side);
  }

  showClasses() {
    const row = lab.byId("lab-classes");
    const names = Object.keys(this.tracker.filters);
    if (names.length === 0) names.push("default");
    if (!names.includes(this.chosenClass)) this.chosenClass = names[0];
    row.replaceChildren(...names.map((name) => {
      const button = document.createElement("button");
      button.type = "button";
      button.textContent = name === "default" ? (names.length === 1 ? "all" : "others") : name;
      button.setAttribute("aria-pressed", name === this.chosenClass);
      button.addEventListener("click", () => { this.chosenClass = name; this.showClasses(); this.showFilter(); this.changed(); });
      return button;
    }));
    if (names.length > 1) {
      const alike = document.createElement("button");
      alike.type = "button";
      alike.textContent = "all alike";
      alike.addEventListener("click", () => {
        this.tracker.filters = { default: lab.copy(this.filter) };
        this.show();
        this.changed();
      });
      row.append(alike);
    }
  }

  showFilter() {
    const [kind, values] = Object.entries(this.filter)[0];
    const form = this.forms.get(kind);
    const kinds = lab.byId("lab-kind");
    if (kinds.options.length === 0) kinds.append(...[...this.forms.keys()].map((name) => lab.option(name)));
    kinds.value = kind;
    kinds.title = form.about;
    const ways = lab.byId("lab-way");
    lab.byId("lab-way-row").hidden = !form.ways;
    let numbers = [];
    if (form.ways) {
      lab.byId("lab-way-label").textContent = lab.spoken(form.way).replace(/^./, (letter) => letter.toUpperCase());
      ways.replaceChildren(...form.ways.map((way) => lab.option(way.kind)));
      ways.value = values[form.way] ?? form.default_way;
      const way = form.ways.find(({ kind: name }) => name === ways.value);
      ways.title = way.about ?? "";
      numbers = way.numbers;
    }
    // What a design can do without, such as one of two ways to say the same, is for the text below.
    numbers = numbers.filter(({ key, required, default: value }) => required || value !== null || values[key] !== undefined);
    numbers = [...numbers, ...form.numbers.filter(({ key }) => key === "switching" || values[key] !== undefined &&
      values[key] !== form.numbers.find((number) => number.key === key).default)];
    lab.byId("lab-filter-sliders").replaceChildren(...numbers.map((number) => {
      const value = values[number.key] ?? number.default ?? 1;
      const [low, high, scale] = lab.rangeOf(number, value);
      return lab.slider({ id: `lab-filter-${number.key}`, label: lab.spoken(number.key), meaning: number.meaning,
        unit: number.unit, low, high, scale, value, whole: number.whole,
        onInput: (v) => { this.filter = { [kind]: { ...values, ...this.filter[kind], [number.key]: v } }; this.showText(); this.changed(); } });
    }));
    this.showText();
  }

  showText() { lab.byId("lab-text").value = lab.flow(this.filter); }

  showSensors() {
    const rows = [];
    this.sensors.forEach((sensor, i) => {
      const add = (key, label, meaning, unit, low, high, scale) => rows.push(lab.slider({
        id: `lab-sensor-${i}-${key}`, label: `${sensor.name}: ${label}`, meaning, unit, low, high, scale,
        value: sensor[key], onInput: (v) => { sensor[key] = v; this.changed(); } }));
      const original = this.scene.sensors[i];
      for (const [key, label, unit] of [["noise", "noise", "m"], ["sigma_range", "noise of range", "m"],
        ["sigma_bearing_deg", "noise of bearing", "°"], ["noise_px", "noise", "px"]]) {
        if (original[key] > 0) add(key, label, "1 sigma", unit, original[key] / 20, original[key] * 20, "factors");
      }
      add("detection_probability", "detects", "share of what it sees", "", 0.05, 1, "even");
      const hasView = this.scene.scenery.sensors[i]?.view.length > 0;
      if (hasView) add("clutter", "clutter", "false detections a scan", "", 0, Math.max(20, 4 * original.clutter), "fine");
    });
    lab.byId("lab-sensor-sliders").replaceChildren(...rows);
  }

  showTracker() {
    const association = lab.byId("lab-association");
    association.replaceChildren(...["nearest-global", "nearest-greedy", "probabilistic", "multi-scan", "known"]
      .map((name) => lab.option(name, name === "known" ? "known (told by the simulation)" : name)));
    association.value = this.tracker.association ?? "nearest-global";
    const life = lab.byId("lab-life");
    life.replaceChildren(lab.option("", "as the scene says"), lab.option("existence"), lab.option("counts"));
    life.value = this.tracker.life_cycle ?? "";
    lab.byId("lab-tracker-sliders").replaceChildren(lab.slider({
      id: "lab-gate", label: "gate", meaning: "sigmas of the innovation", unit: "", low: 0.5, high: 15,
      scale: "fine", value: this.tracker.gate, onInput: (v) => { this.tracker.gate = v; this.changed(); } }));
  }

  listen() {
    const on = (id, event, action) => lab.byId(id).addEventListener(event, action);
    lab.byId("lab-controls").addEventListener("submit", (event) => event.preventDefault());
    on("lab-compare", "change", (event) => {
      const choice = event.target.value;
      this.trackers.length = 1;
      if (choice !== "") this.trackers[1] = lab.copy(this.trackers[0]);
      if (choice.startsWith("filter ")) this.trackers[1].filters = { default: lab.copy(this.scene.compare[choice.slice(7)]) };
      this.otherName = choice.startsWith("filter ") ? choice.slice(7) : "";
      this.side = choice === "copy" ? 1 : 0;
      this.show();
      this.changed();
    });
    for (const button of lab.byId("lab-sides").children) {
      button.addEventListener("click", () => { this.side = Number(button.dataset.side); this.show(); this.changed(); });
    }
    on("lab-kind", "change", (event) => {
      this.filter = { [event.target.value]: this.usual(event.target.value) };
      this.showFilter();
      this.changed();
    });
    on("lab-way", "change", (event) => {
      const kind = Object.keys(this.filter)[0];
      this.filter = { [kind]: this.usual(kind, event.target.value) };
      this.showFilter();
      this.changed();
    });
    on("lab-text", "change", (event) => { this.typed = event.target.value; this.changed(); });
    on("lab-association", "change", (event) => { this.tracker.association = event.target.value; this.changed(); });
    on("lab-life", "change", (event) => {
      if (event.target.value === "") delete this.tracker.life_cycle;
      else this.tracker.life_cycle = event.target.value;
      this.changed();
    });
    on("lab-reset", "click", () => { lab.byId("lab-compare").value = ""; this.reset(); this.changed(); });
  }
};
