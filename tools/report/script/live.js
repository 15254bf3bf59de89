// The part of a report that integrates: sliders, the motion, the section. All work is done by
// workers, which run `integrator`; what a case file says is shown as text and never as markup.
class LivePage {
  constructor(data, place) {
    this.data = data;
    this.state = [...data.initial];
    this.parameters = [...data.values];
    this.duration = data.duration;
    this.task = 0;
    this.workers = [];
    this.build(place);
    // At first the motion that casimir integrated: what the worker finds is the same.
    if (data.motion) this.chart(data.motion);
    this.bytes = Uint8Array.from(atob(data.wasm), c => c.charCodeAt(0));
    this.runner = this.worker(message => this.moved(message));
    this.change();
  }

  worker(take) {
    const address = URL.createObjectURL(new Blob([`(${integrator})()`], {type: 'text/javascript'}));
    const worker = new Worker(address);
    worker.onmessage = message => {
      if (message.data.kind === 'problem') this.say(`The browser does not let this page compute: ${message.data.words}`);
      else take(message.data);
    };
    worker.onerror = event => this.say(`The browser does not let this page compute: ${event.message || 'no worker'}`);
    const {wasm, motion, ...data} = this.data;
    worker.postMessage({kind: 'module', bytes: this.bytes, data});
    return worker;
  }

  // --- what stands there

  build(place) {
    const {data} = this;
    this.words = htmlNode('p', {id: 'live-words'});
    this.words.setAttribute('role', 'status');
    this.command = htmlNode('code', {id: 'live-command'});
    this.charts = htmlNode('div', {id: 'live-motion'});
    this.numbers = htmlNode('div', {className: 'scroll'});
    const reset = htmlNode('button', {type: 'button', textContent: 'as in the case file'});
    reset.addEventListener('click', () => this.reset());
    const open = matchMedia('(min-width: 40rem)').matches && data.states.length <= 8;
    const section = htmlNode('section', {id: 'live'},
      htmlNode('h2', {textContent: 'Integrate here'}),
      htmlNode('p', {className: 'soft', textContent:
        `Scene ${data.scene}. Move a slider, or type a number: the page integrates anew, in double precision, `
        + 'by Taylor series in WebAssembly that casimir wrote for these equations.'}),
      this.controls('Parameters', data.parameters, this.parameters, true),
      this.controls('Initial state', data.states, this.state, open),
      this.endControl(reset), this.words, this.charts, this.numbers,
      htmlNode('p', {className: 'soft screen'}, 'The same on the command line: ', this.command));
    if (data.section) section.append(...this.sectionNodes());
    place.replaceWith(section);
    const link = htmlNode('li', {}, htmlNode('a', {href: '#live', textContent: 'Integrate here'}));
    document.querySelector('nav ul')?.append(link);
    this.inputs = [...section.querySelectorAll('input[data-list]')];
  }

  controls(title, names, values, open) {
    if (names.length === 0) return '';
    const size = Math.max(...values.map(Math.abs)) || 1;
    const rows = names.map((name, i) => this.control(name, values, i, size));
    return htmlNode('details', {open, className: 'controls'}, htmlNode('summary', {textContent: title}), ...rows);
  }

  control(name, list, index, size) {
    const value = list[index], half = 2 * (Math.abs(value) || size);
    const slider = htmlNode('input', {type: 'range', min: value - half, max: value + half, step: half / 500});
    const number = htmlNode('input', {type: 'text', inputMode: 'decimal', value: String(value)});
    slider.value = value;
    slider.setAttribute('aria-label', name);
    number.setAttribute('aria-label', `value of ${name}`);
    number.dataset.list = list === this.state ? 'state' : 'parameters';
    number.dataset.name = name;
    const set = (x, from) => {
      const good = Number.isFinite(x);
      number.classList.toggle('wrong', !good);
      if (!good) return;
      list[index] = x;
      if (from !== slider) slider.value = x;
      if (from !== number) number.value = String(x);
      this.change();
    };
    slider.addEventListener('input', () => set(Number(Number(slider.value).toPrecision(6)), slider));
    number.addEventListener('change', () => set(number.value.trim() === '' ? NaN : Number(number.value), number));
    number.show = () => { number.value = String(list[index]); slider.value = list[index]; number.classList.remove('wrong'); };
    return htmlNode('label', {}, htmlNode('span', {textContent: name}), slider, number);
  }

  endControl(reset) {
    const number = htmlNode('input', {type: 'text', inputMode: 'decimal', value: String(this.duration), id: 'live-duration'});
    number.addEventListener('change', () => {
      const x = Number(number.value), good = Number.isFinite(x) && x !== 0;
      number.classList.toggle('wrong', !good);
      if (!good) return;
      this.duration = x;
      this.change();
    });
    this.durationInput = number;
    return htmlNode('p', {className: 'end'}, htmlNode('label', {}, 'up to t = ', number), ' ', reset);
  }

  reset() {
    this.data.initial.forEach((x, i) => { this.state[i] = x; });
    this.data.values.forEach((x, i) => { this.parameters[i] = x; });
    this.duration = this.data.duration;
    this.durationInput.value = String(this.duration);
    for (const input of this.inputs) input.show();
    this.change();
  }

  say(words) { this.words.textContent = words; }

  // --- the motion

  change() {
    if (this.busy) {
      this.again = true;
      return;
    }
    this.busy = true;
    this.runner.postMessage({kind: 'motion', id: ++this.task, state: [...this.state],
      parameters: [...this.parameters], duration: this.duration});
    if (this.picture) this.picture.stale();
  }

  moved(result) {
    if (result.kind === 'orbit') return this.picture.take(result);
    if (result.kind === 'picture') return this.chart(result);
    this.busy = false;
    if (this.again) {
      this.again = false;
      this.change();
    }
    this.result = result;
    this.tell(result);
    this.table(result);
    const changed = (list, given, names, option) => list
      .map((x, i) => x === given[i] ? '' : ` --${option} ${names[i]}=${x}`).join('');
    this.command.textContent = this.data.command
      + changed(this.parameters, this.data.values, this.data.parameters, 'param')
      + changed(this.state, this.data.initial, this.data.states, 'initial')
      + (this.duration === this.data.duration ? '' : ` --duration ${this.duration}`);
  }

  warnings(first) {
    const list = [];
    const holds = {'!=': x => x !== 0, '==': x => x === 0, '>': x => x > 0, '>=': x => x >= 0, '<': x => x < 0, '<=': x => x <= 0};
    for (const one of this.data.conditions)
      if (!holds[one.comparison](first[one.at])) list.push(`Outside of what the case assumes: ${one.text}.`);
    for (const one of this.data.constraints)
      if (!(Math.abs(first[one.at]) < 1e-9)) list.push(`The start does not lie where ${one.text} = 0, as the case wants it: it is ${shortNumber(first[one.at])} there.`);
    return list;
  }

  /** What three more runs say: with series of a lower order, with shorter steps, and with the last
      bit of the data changed. What all runs pass over, or lose, alike they do not tell. */
  digitsInWords(digits) {
    if (digits === null) return 'How many digits of it are right is not known: with other steps, or the last bit of the data changed, a run does not come to the end.';
    if (digits === 0) return 'Nothing of the end state is to be believed: with other steps, or the last bit of the data changed, it is another one.';
    return `${digits} digits of the largest state stay the same with other steps, and with the last bit of the data changed. What is shorter than all steps, or what rounding takes from all runs alike, that does not tell: casimir integrate looks for both.`;
  }

  tell(result) {
    const list = this.warnings(result.first);
    if (result.why) {
      list.push(`Stopped at t = ${shortNumber(result.t)}, before the end: ${result.why}. What is shown is the motion up to there.`);
    } else {
      list.push(`t = ${shortNumber(result.t)} in ${result.steps} steps.`);
      list.push(this.digitsInWords(result.digits));
    }
    this.words.className = result.why || result.digits === null || result.digits < 3 || list.length > 2 ? 'notes' : '';
    this.say(list.join(' '));
  }

  table(result) {
    const row = (cells, kind) => htmlNode('tr', {}, ...cells.map(text => htmlNode(kind, {textContent: text})));
    const states = htmlNode('table', {id: 'live-state'}, row(['at the end', result.why ? `t = ${shortNumber(result.t)}` : 'value'], 'th'));
    result.state.forEach((x, i) => {
      const line = row([this.data.states[i], x.toPrecision(17).replace('-', '\u2212')], 'td');
      line.dataset.value = x.toPrecision(17);
      states.append(line);
    });
    const kept = htmlNode('table', {id: 'live-kept'}, row(['function', 'at the start', 'changes by'], 'th'));
    this.data.functions.slice(0, this.data.invariants).forEach((name, i) =>
      kept.append(row([name, shortNumber(result.first[i]), result.change[i].toExponential(1).replace('-', '\u2212')], 'td')));
    this.numbers.replaceChildren(htmlNode('div', {className: 'pair'}, states, this.data.invariants > 0 ? kept : ''));
  }

  /** Names that begin with the same letters share a picture. */
  groups() {
    const groups = new Map();
    this.data.states.forEach((name, i) => {
      const stem = name.replace(/[_\d].*$/, '');
      if (!groups.has(stem)) groups.set(stem, []);
      groups.get(stem).push(i);
    });
    return [...groups.values()];
  }

  chart(result) {
    const width = Math.max(260, Math.min(this.charts.clientWidth || 600, 600)), height = 170;
    this.charts.replaceChildren(...this.groups().map((group, k) => this.panel(result, group, k, width, height)));
    performance.mark('casimir-picture');
  }

  panel(result, group, k, width, height) {
    const svg = svgNode('svg', {viewBox: `0 0 ${width} ${height}`, role: 'img'});
    const names = group.map(i => this.data.states[i]);
    svgNode('title', {}, svg).textContent = `${names.join(', ')} against time`;
    const {times, samples} = result, end = times[times.length - 1];
    const values = group.flatMap(i => samples.map(x => x[i])).filter(Number.isFinite);
    let low = values.reduce((a, b) => Math.min(a, b), Infinity), high = values.reduce((a, b) => Math.max(a, b), -Infinity);
    const margin = 0.05 * (high - low) || 0.1 * Math.abs(high) || 1;
    low -= margin;
    high += margin;
    const x = new PlotAxis(58, width - 10, Math.min(0, end), Math.max(0, end) || 1, false);
    const y = new PlotAxis(height - 26, 22, low, high, false);
    const frame = svgNode('g', {'font-size': 12, 'font-family': 'sans-serif', fill: 'var(--plot-ink)'}, svg);
    const tick = (d, at, text) => {
      const group = svgNode('g', {}, frame);
      svgNode('path', {d, stroke: 'var(--plot-grid)'}, group);
      svgNode('text', at, svgNode('g', {}, group)).textContent = text;
    };
    for (const v of roundValues(x.value(x.from), x.value(x.to), false))
      tick(`M${x.at(v)},${y.from}V${y.to}`, {x: x.at(v), y: height - 9, 'text-anchor': 'middle'}, shortNumber(v));
    for (const v of roundValues(low, high, false))
      tick(`M${x.from},${y.at(v)}H${x.to}`, {x: x.from - 6, y: y.at(v) + 4, 'text-anchor': 'end'}, shortNumber(v));
    let legend = x.from;
    group.forEach((i, j) => {
      const colour = `var(--plot-${j % 12 + 1})`, name = this.data.states[i];
      const curve = svgNode('g', {id: `live-${k}-gnuplot_plot_${j + 1}`}, svg);
      svgNode('title', {}, curve).textContent = name;
      const d = times.map((t, m) => Number.isFinite(samples[m][i]) ? `L${x.at(t).toFixed(2)},${y.at(samples[m][i]).toFixed(2)}` : '')
        .join(' ').replace('L', 'M');
      svgNode('path', {d: d || 'M0,0', fill: 'none', stroke: colour, 'stroke-width': 1.5}, curve);
      svgNode('path', {d: `M${legend},9h16`, stroke: colour, 'stroke-width': 3}, svg);
      svgNode('text', {x: legend + 21, y: 13, 'font-size': 13, 'font-family': 'sans-serif', fill: 'var(--plot-ink)'}, svg).textContent = name;
      legend += 9 * name.length + 37;
    });
    svg.dataset.axes = [x.from, x.to, height - y.from, height - y.to, x.value(x.from), x.value(x.to), low, high, 0, 0].join(' ');
    const figure = htmlNode('figure', {id: `live-figure-${k}`}, svg);
    new PlotView(svg);
    return figure;
  }

  // --- the section

  sectionNodes() {
    this.picture = new SectionPicture(this);
    return this.picture.nodes;
  }
}

/** Crossings of the plane, on a canvas that can be clicked. */
class SectionPicture {
  constructor(page) {
    this.page = page;
    this.data = page.data.section;
    this.orbits = [];
    this.words = htmlNode('p', {id: 'section-words', className: 'soft'});
    this.words.setAttribute('role', 'status');
    this.canvas = htmlNode('canvas', {id: 'section-canvas'});
    this.canvas.setAttribute('role', 'img');
    this.canvas.setAttribute('aria-label', `Poincar\u00e9 section, ${this.data.labels.join(' and ')}; a click starts an orbit`);
    this.button = htmlNode('button', {type: 'button', textContent: 'draw the section', id: 'section-draw'});
    this.button.addEventListener('click', () => this.begin());
    this.canvas.addEventListener('click', event => this.click(event));
    this.nodes = [htmlNode('h3', {textContent: 'Its section'}),
      htmlNode('p', {className: 'soft', textContent: 'On the level of the start above. A click in the picture starts the orbit that is seen there.'}),
      htmlNode('p', {}, this.button), this.words, this.canvas];
    new ResizeObserver(() => this.draw()).observe(this.canvas);
    matchMedia('(prefers-color-scheme: dark)').addEventListener('change', () => this.draw());
    // Drawn as soon as somebody looks at it.
    new IntersectionObserver((entries, observer) => {
      if (!entries.some(entry => entry.isIntersecting)) return;
      observer.disconnect();
      this.begin();
    }, {rootMargin: '200px'}).observe(this.canvas);
  }

  stale() {
    this.old = true;
    if (this.begun) this.words.textContent = 'The section is that of the start before; draw it anew.';
  }

  start() {
    const count = Math.min(4, Math.max(1, (navigator.hardwareConcurrency || 2) - 1));
    this.workers ??= Array.from({length: count}, () => this.page.worker(message => this.take(message)));
    return this.workers;
  }

  request(kind) {
    return {kind, id: this.id, state: [...this.page.state], parameters: [...this.page.parameters]};
  }

  begin() {
    const workers = this.start();
    this.begun = true;
    this.old = false;
    this.id = (this.id || 0) + 1;
    this.orbits = [];
    this.running = workers.length;
    this.refused = 0;
    this.words.textContent = 'Orbits are being cut \u2026';
    workers.forEach((worker, k) => worker.postMessage({...this.request('section'), count: 200,
      seeds: this.data.seeds.filter((_, i) => i % workers.length === k)}));
    this.draw();
  }

  click(event) {
    if (!this.frame || this.old) return this.begin();
    const box = this.canvas.getBoundingClientRect();
    const place = [this.frame.x.value(event.clientX - box.left), this.frame.y.value(event.clientY - box.top)]
      .map((x, i) => x * this.unit(i));
    const far = ([u, v]) => {
      const apart = (x, i) => {
        const period = this.data.periods[i], range = this.range[i][1] - this.range[i][0];
        const d = period > 0 ? x - period * Math.round(x / period) : x;
        return (d / (range || 1)) ** 2;
      };
      return apart(u - place[0], 0) + apart(v - place[1], 1);
    };
    const known = this.orbits.flatMap(orbit => orbit.states.map((state, i) =>
      ({state, far: far([orbit.places[2 * i], orbit.places[2 * i + 1]])})));
    known.sort((a, b) => a.far - b.far);
    this.words.textContent = 'The orbit is sought \u2026';
    this.page.runner.postMessage({...this.request('seed'), place, count: 1000,
      near: known.filter((_, i) => i < 6 || i % 97 === 0).slice(0, 14).map(one => one.state)});
  }

  take(message) {
    if (message.id !== this.id) return;
    if (message.kind === 'done') {
      if (--this.running === 0) this.finish();
      return;
    }
    if (message.places.length === 0) {
      ++this.refused;
      if (message.index < 0) this.words.textContent = `No orbit: ${message.why}.`;
      return;
    }
    if (message.index < 0)
      this.words.textContent = `${message.states.length} crossings of the orbit that starts at `
        + message.start.map((x, i) => `${this.page.data.states[i]} = ${shortNumber(x)}`).join(', ')
        + (message.why ? `; it ends there: ${message.why}.` : '.');
    this.orbits.push({...message, seeded: message.index < 0});
    this.later();
  }

  finish() {
    const crossings = this.orbits.reduce((n, orbit) => n + orbit.states.length, 0);
    const ended = this.orbits.filter(orbit => orbit.why).length;
    this.words.textContent = `${this.orbits.length} orbits, ${crossings} crossings.`
      + (this.refused > 0 ? ` ${this.refused} more starts have no place on this level.` : '')
      + (ended > 0 ? ` ${ended} orbits could not be followed to the end.` : '');
    this.canvas.dataset.crossings = crossings;
  }

  later() {
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.draw();
    });
  }

  /** Angles are shown in units of pi. */
  unit(i) { return this.data.periods[i] > 0 ? Math.PI : 1; }

  within(value, i) {
    const period = this.data.periods[i];
    return period > 0 ? value - period * Math.floor(value / period) : value;
  }

  measure() {
    this.range = [0, 1].map(i => {
      if (this.data.periods[i] > 0) return [0, this.data.periods[i]];
      let low = Infinity, high = -Infinity;
      for (const orbit of this.orbits)
        for (let k = i; k < orbit.places.length; k += 2) {
          if (!Number.isFinite(orbit.places[k])) continue;
          low = Math.min(low, orbit.places[k]);
          high = Math.max(high, orbit.places[k]);
        }
      const margin = 0.04 * (high - low) || 1;
      return low > high ? [-1, 1] : [low - margin, high + margin];
    });
  }

  draw() {
    const width = this.canvas.clientWidth, height = this.canvas.clientHeight, scale = devicePixelRatio || 1;
    if (width === 0) return;
    this.canvas.width = width * scale;
    this.canvas.height = height * scale;
    const pen = this.canvas.getContext('2d'), style = getComputedStyle(document.documentElement);
    const colour = name => style.getPropertyValue(`--plot-${name}`).trim();
    pen.scale(scale, scale);
    this.measure();
    const axis = (i, from, to) => new PlotAxis(from, to, this.range[i][0] / this.unit(i), this.range[i][1] / this.unit(i), false);
    const x = axis(0, 62, width - 10), y = axis(1, height - 42, 10);
    this.frame = {x, y};
    pen.font = '13px sans-serif';
    pen.fillStyle = colour('ink');
    pen.strokeStyle = colour('grid');
    pen.textAlign = 'center';
    for (const v of roundValues(x.value(x.from), x.value(x.to), false)) {
      pen.strokeRect(x.at(v), y.to, 0, y.from - y.to);
      pen.fillText(shortNumber(v), x.at(v), y.from + 17);
    }
    pen.fillText(this.label(0), (x.from + x.to) / 2, height - 8);
    pen.textAlign = 'right';
    for (const v of roundValues(y.value(y.from), y.value(y.to), false)) {
      pen.strokeRect(x.from, y.at(v), x.to - x.from, 0);
      pen.fillText(shortNumber(v), x.from - 6, y.at(v) + 4);
    }
    pen.save();
    pen.translate(13, (y.from + y.to) / 2);
    pen.rotate(-Math.PI / 2);
    pen.textAlign = 'center';
    pen.fillText(this.label(1), 0, 0);
    pen.restore();
    pen.strokeStyle = colour('ink');
    pen.strokeRect(x.from, y.to, x.to - x.from, y.from - y.to);
    this.orbits.forEach((orbit, k) => {
      const size = orbit.seeded ? 2.4 : 1.6;
      pen.fillStyle = colour(orbit.seeded ? 2 : [1, 3, 7, 5, 8, 10][k % 6]);
      for (let i = 0; i < orbit.places.length; i += 2) {
        const a = x.at(this.within(orbit.places[i], 0) / this.unit(0)), b = y.at(this.within(orbit.places[i + 1], 1) / this.unit(1));
        pen.fillRect(a - size / 2, b - size / 2, size, size);
      }
    });
  }

  label(i) {
    const name = this.data.labels[i];
    return this.data.periods[i] > 0 ? `${/^\w+$/.test(name) ? name : `(${name})`}/\u03c0` : name;
  }
}

{
  const source = document.getElementById('live-data'), place = document.getElementById('live-place');
  if (source && place && window.WebAssembly && window.Worker)
    new LivePage(JSON.parse(source.textContent), place);
}
