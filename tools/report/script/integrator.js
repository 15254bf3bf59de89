// What a worker of a report does: orbits by Taylor series, their crossings of a plane, and starts on
// a level. The series come from the WebAssembly module of the page; a page makes workers of the text
// of this function.
function integrator() {
  'use strict';
  const EPSILON = 2 ** -54;     // what the last terms of a series may be of a state
  const DEFECT = 1e-11;         // how far rates along a step may be from the equations, of a state
  const LONGEST = 16;           // steps, in units
  const SHORTEST = 16 * 2 ** -52;  // steps, of the time
  const MOST_STEPS = 400000;
  const GOLDEN = 0.6180339887498949;
  const biggest = list => list.reduce((most, x) => Math.max(most, Math.abs(x)), 0);

  /** The functions of the module, and the numbers in its memory. */
  class System {
    constructor(exports, data) {
      this.exports = exports;
      this.numbers = new Float64Array(exports.memory.buffer);
      this.n = data.states.length;
      const at = data.layout, place = bytes => bytes / 8;
      this.order = at.order;
      for (const key of ['inputs', 'unit', 'rates', 'values', 'stride', 'states'])
        this[key] = place(at[key]);
      for (const key of ['followed', 'singular', 'kinks']) this[key] = at[key].map(place);
      this.compared = at.compared;
      this.time = this.inputs + this.n + data.parameters.length;
      this.count = data.functions.length;
      this.section = data.section;
    }

    prepare(parameters) {
      this.numbers.set(parameters, this.inputs + this.n);
      this.exports.prepare();
    }

    enter(t, x) {
      this.numbers.set(x, this.inputs);
      this.numbers[this.time] = t;
    }

    expand(t, x, unit, order) {
      this.enter(t, x);
      this.numbers[this.unit] = unit;
      this.exports.expand(order);
    }

    ratesAt(t, x) {
      this.enter(t, x);
      this.exports.rates();
      return this.numbers.subarray(this.rates, this.rates + this.n);
    }

    functionsAt(t, x) {
      this.enter(t, x);
      this.exports.evaluate();
      return this.numbers.slice(this.values, this.values + this.count);
    }
  }

  /** How often the coefficients in Bernstein's basis change their sign. */
  const changes = b => {
    let count = 0, last = 0;
    for (const x of b) {
      if (x !== 0 && last !== 0 && (x > 0) !== (last > 0)) ++count;
      if (x !== 0) last = x;
    }
    return count;
  };

  /** The polynomial with these coefficients on [0, 1] in Bernstein's basis. */
  function bernstein(c) {
    const n = c.length - 1, b = Float64Array.from(c);
    for (let k = 1, binomial = 1; k <= n; ++k) {
      binomial *= (n - k + 1) / k;
      b[k] /= binomial;
    }
    for (let round = 1; round <= n; ++round)
      for (let k = n; k >= round; --k) b[k] += b[k - 1];
    return b;
  }

  const value = (c, s) => c.reduceRight((sum, x) => sum * s + x, 0);

  /** The one zero in a bracket. */
  function bisected(c, from, to) {
    const left = value(c, from) > 0;
    for (let i = 0; i < 60 && to - from > 1e-16; ++i) {
      const middle = (from + to) / 2;
      if (value(c, middle) > 0 === left) from = middle; else to = middle;
    }
    return (from + to) / 2;
  }

  /** The zeros of a polynomial in (0, 1), isolated by Descartes' rule of signs in Bernstein's basis;
      where it touches zero there is none. */
  function zeros(c) {
    const found = [];
    const search = (b, from, to, depth) => {
      const count = changes(b);
      if (count === 0 || depth === 0) return;
      if (count === 1 && (b[0] > 0) !== (b[b.length - 1] > 0)) {
        found.push(bisected(c, from, to));
        return;
      }
      const left = [], right = Float64Array.from(b), middle = (from + to) / 2;
      for (let k = 0; k < b.length; ++k) {  // de Casteljau
        left.push(right[0]);
        for (let i = 0; i + 1 < b.length - k; ++i) right[i] = (right[i] + right[i + 1]) / 2;
      }
      search(left, from, middle, depth - 1);
      search(right, middle, to, depth - 1);
    };
    search(bernstein(c), 0, 1, 30);
    return found;
  }

  /** One orbit, step by step. */
  class Orbit {
    /** `longest`: no step is longer, in time, and the equations are looked at within each, too. */
    constructor(system, x, order, backward = false, longest = Infinity) {
      this.system = system;
      this.order = order;
      this.longest = longest;
      this.most = MOST_STEPS;
      this.x = Float64Array.from(x);
      this.lost = new Float64Array(system.n);  // by rounding, of the states
      this.t = 0;
      this.timeLost = 0;
      this.steps = 0;
      this.place = 0.5;
      const rate = biggest(system.ratesAt(0, x));
      this.unit = (backward ? -1 : 1) * (rate > 0 ? 0.1 * (biggest(x) || 1) / rate : 1);
      if (!Number.isFinite(this.unit) || this.unit === 0) this.unit = backward ? -1 : 1;
    }

    coefficient(i, k) { return this.system.numbers[this.system.states + i * this.system.stride + k]; }

    /** The longest step in units whose last terms are small; NaN where a coefficient is no number. */
    length() {
      const {numbers, states, stride, n, singular} = this.system;
      let length = LONGEST;
      const shorten = (at, order, least) => {
        const scale = Math.max(Math.abs(numbers[at]), Math.abs(numbers[at + 1]), least);
        for (let k = 0; k <= order; ++k) if (!Number.isFinite(numbers[at + k])) length = NaN;
        for (let k = order - 2; k <= order; ++k) {
          const size = Math.abs(numbers[at + k]) / scale;
          if (size > 0) length = Math.min(length, (EPSILON / size) ** (1 / k));
        }
      };
      let size = 0;
      for (let i = 0; i < n; ++i) size = Math.max(size, Math.abs(numbers[states + i * stride]));
      for (let i = 0; i < n; ++i) shorten(states + i * stride, this.order, 1e-30 * size);
      for (const at of singular) shorten(at, this.order - 1, 1e-300);
      return length;
    }

    /** The states at a share of the step of h units, and their rates per unit. */
    stateAt(h, rates = null) {
      const x = new Float64Array(this.system.n);
      for (let i = 0; i < x.length; ++i) {
        let sum = 0, slope = 0;
        for (let k = this.order; k > 0; --k) {
          slope = slope * h + sum;
          sum = sum * h + this.coefficient(i, k);
        }
        if (rates) rates[i] = slope * h + sum;
        x[i] = this.x[i] + (sum * h + this.lost[i]);
      }
      return x;
    }

    /** Whether the series says the same as the equations, at a place of the step. */
    agreesAt(h, length) {
      const n = this.system.n, rates = new Float64Array(n);
      const x = this.stateAt(h, rates);
      const wanted = this.system.ratesAt(this.t + h * this.unit, x);
      let size = 0;
      const sizes = rates.map((_, i) => {
        let most = Math.max(Math.abs(this.x[i]), Math.abs(x[i]));
        for (let k = 1, power = length; k <= this.order; ++k, power *= length)
          most = Math.max(most, Math.abs(this.coefficient(i, k)) * power);
        size = Math.max(size, most);
        return most;
      });
      for (let i = 0; i < n; ++i) {
        const defect = Math.abs(rates[i] - wanted[i] * this.unit) * length;
        if (!(defect <= DEFECT * (sizes[i] + 1e-10 * size))) return false;
      }
      return true;
    }

    polynomial(at, h) {
      const c = new Float64Array(this.order);
      for (let k = 0, power = 1; k < this.order; ++k, power *= h) c[k] = this.system.numbers[at + k] * power;
      return c;
    }

    /** Whether a step of h units holds: no kink is in it unless it is very short, and the equations
        agree at its end, and where functions have branches within it too. */
    holds(h, natural) {
      const short = h <= 1e-10 * natural;
      if (!short)
        for (const at of this.system.kinks)
          if (changes(bernstein(this.polynomial(at, h))) > 0) return false;
      if (this.system.compared || this.longest < Infinity) {
        this.place = (this.place + GOLDEN) % 1;
        if (!this.agreesAt(h * (0.1 + 0.8 * this.place), h)) return false;
      }
      return this.agreesAt(h, h);
    }

    /** Goes one step, to `end` at most. The step is in `h` units of `was`, with the series still
        there, until `accept`. Returns why it cannot, or nothing. */
    step(end) {
      const {system} = this;
      const least = () => SHORTEST * Math.max(Math.abs(this.t), 1e-290);
      if (++this.steps > this.most) return 'it takes too many steps';
      for (;;) {
        system.expand(this.t, this.x, this.unit, this.order);
        const natural = this.length();
        if (Number.isNaN(natural)) {
          this.unit /= 256;
          if (Math.abs(this.unit) < least()) return 'the equations have no finite value there';
          continue;
        }
        const left = (end - this.t) / this.unit;
        // Where there is a longest step, what would do is shortened as well.
        const short = this.longest < Infinity;
        let h = Math.min(short ? natural / 2 : natural, left, this.longest / Math.abs(this.unit));
        this.last = h === left;
        while (!this.holds(h, natural)) {
          h /= 2;
          this.last = false;
          if (!(h * Math.abs(this.unit) > least()))
            return 'its steps become too short: a singularity, or a kink of the equations';
        }
        this.h = h;
        this.end = end;
        this.next = this.unit * Math.min(Math.max(natural, 0.01), LONGEST);
        return '';
      }
    }

    accept() {
      const add = (sum, lost, term) => {  // with what was lost by rounding (Kahan, Neumaier)
        const part = term + lost, total = sum + part;
        const error = Math.abs(sum) >= Math.abs(part) ? sum - total + part : part - total + sum;
        return [total, error];
      };
      for (let i = 0; i < this.system.n; ++i) {
        let sum = 0;
        for (let k = this.order; k > 0; --k) sum = (sum + this.coefficient(i, k)) * this.h;
        [this.x[i], this.lost[i]] = add(this.x[i], this.lost[i], sum);
      }
      [this.t, this.timeLost] = add(this.t, this.timeLost, this.h * this.unit);
      if (this.last) this.t = this.end;
      this.unit = this.next;
    }
  }

  /** Runs to the end; `look` is shown each step before it is accepted. */
  function run(orbit, end, look = () => {}) {
    while (orbit.t !== end) {
      const why = orbit.step(end);
      if (why) return why;
      look(orbit);
      orbit.accept();
      if (!orbit.x.every(Number.isFinite)) return 'a state is no finite number';
    }
    return '';
  }

  const distance = (a, b) => a.reduce((most, x, i) => Math.max(most, Math.abs(x - b[i])), 0);

  /** How many decimal digits two states have in common, of the size of the larger. */
  function commonDigits(a, b) {
    const size = Math.max(biggest(a), biggest(b)), apart = distance(a, b);
    if (!Number.isFinite(apart)) return 0;
    return apart === 0 ? 16 : Math.max(0, -Math.log10(apart / size));
  }

  /** The end state of a run that differs in its rounding: other steps, or the last bit of the data.
      Null where it does not come to the end. */
  function otherEnd(system, task, {order = system.order, shake = false, longest = Infinity}) {
    const shaken = list => list.map((x, i) => x * (1 + (shake ? (i % 2 ? -1 : 1) * 2 ** -52 : 0)));
    system.prepare(shaken(task.parameters));
    const orbit = new Orbit(system, shaken(task.state), order, task.duration < 0, longest);
    orbit.most = 3 * MOST_STEPS;
    const why = run(orbit, task.duration);
    return why ? null : orbit.x;
  }

  /** The motion: samples of its first part, its end, and how many digits of that other runs have as
      well; null where one of these does not come to the end. */
  function motion(system, task) {
    const PARTS = 10, SHOWN = 160;  // samples of a step, steps
    const order = system.order;
    system.prepare(task.parameters);
    const orbit = new Orbit(system, task.state, order, task.duration < 0);
    const first = system.functionsAt(0, task.state);
    const times = [0], samples = [Array.from(task.state)], change = first.map(() => 0);
    let shown = false;
    const show = () => {
      shown = true;
      postMessage({id: task.id, kind: 'picture', times, samples});
    };
    const why = run(orbit, task.duration, one => {
      const end = one.stateAt(one.h);
      system.functionsAt(one.t + one.h * one.unit, end)
        .forEach((x, i) => { change[i] = Math.max(change[i], Math.abs(x - first[i])); });
      if (one.steps > SHOWN) {
        if (!shown) show();
        return;
      }
      for (let j = 1; j <= PARTS; ++j) {
        times.push(one.t + one.h * one.unit * j / PARTS);
        samples.push(Array.from(one.stateAt(one.h * j / PARTS)));
      }
    });
    if (!shown) show();
    const end = orbit.x;
    let digits = null;
    if (!why) {
      const others = [otherEnd(system, task, {order: order - 4}), otherEnd(system, task, {shake: true}),
        otherEnd(system, task, {longest: Math.abs(task.duration) / 200})];
      if (others.every(x => x))
        digits = Math.floor(Math.min(15, ...others.map(x => commonDigits(end, x))));
    }
    return {first: Array.from(first), change: Array.from(change), why, digits,
      t: orbit.t, state: Array.from(end), steps: orbit.steps};
  }

  /** Solves a x = b by elimination; null where it has no solution. */
  function solved(a, b) {
    const n = b.length;
    for (let k = 0; k < n; ++k) {
      let p = k;
      for (let i = k; i < n; ++i) if (Math.abs(a[i][k]) > Math.abs(a[p][k])) p = i;
      if (!(Math.abs(a[p][k]) > 1e-200)) return null;
      [a[k], a[p]] = [a[p], a[k]];
      [b[k], b[p]] = [b[p], b[k]];
      for (let i = k + 1; i < n; ++i) {
        const factor = a[i][k] / a[k][k];
        for (let j = k; j < n; ++j) a[i][j] -= factor * a[k][j];
        b[i] -= factor * b[k];
      }
    }
    for (let k = n - 1; k >= 0; --k) {
      for (let j = k + 1; j < n; ++j) b[k] -= a[k][j] * b[j];
      b[k] /= a[k][k];
    }
    return b;
  }

  const wrapped = (x, period) => period > 0 ? x - period * Math.round(x / period) : x;

  /** A point of the plane on the level, and at a place of the picture if there is one: from a start,
      by Newton's method with the shortest correction. Null where it does not arrive. */
  function projected(system, start, levels, place) {
    const {section} = system;
    const misses = x => {
      const f = system.functionsAt(0, x);
      const list = [f[section.plane], ...levels.map((level, i) => f[i] - level)];
      if (place)
        section.pair.forEach((at, i) => list.push(wrapped(f[at] - place[i], section.periods[i])));
      return list;
    };
    const scale = [1, ...levels.map(x => Math.max(1, Math.abs(x))), 1, 1];
    const size = list => list.reduce((most, x, i) => Math.max(most, Math.abs(x) / scale[i]), 0);
    let x = Float64Array.from(start), miss = misses(x);
    for (let round = 0; round < 60; ++round) {
      if (!Number.isFinite(size(miss))) return null;
      if (size(miss) < 2e-15) break;
      const slopes = miss.map(() => []);
      for (let i = 0; i < x.length; ++i) {
        const h = 1e-6 * Math.max(1e-3, Math.abs(x[i]));
        const there = Float64Array.from(x), back = Float64Array.from(x);
        there[i] += h;
        back[i] -= h;
        const a = misses(there), b = misses(back);
        slopes.forEach((row, k) => { row[i] = (a[k] - b[k]) / (2 * h); });
      }
      const square = slopes.map(row => slopes.map(other => row.reduce((s, v, i) => s + v * other[i], 0)));
      const weights = solved(square, [...miss]);
      if (!weights) return null;
      let moved = null;
      for (let share = 1; share > 1e-3; share /= 2) {
        const next = x.map((v, i) => v - share * slopes.reduce((s, row, k) => s + row[i] * weights[k], 0));
        const there = misses(next);
        if (size(there) < size(miss)) {
          moved = [next, there];
          break;
        }
      }
      if (!moved) break;
      [x, miss] = moved;
    }
    return size(miss) < 1e-12 ? x : null;
  }

  /** Whether the plane is crossed there in the direction that is shown. */
  function crossesWell(system, x) {
    system.expand(0, x, 1, 2);
    const speed = system.numbers[system.followed[0] + 1];
    return system.section.upwards ? speed > 0 : speed < 0;
  }

  /** The crossings of the plane by the orbit of a state: [u, v] of each, and its states. */
  function crossings(system, start, count) {
    const {section} = system, places = [], states = [];
    const orbit = new Orbit(system, start, system.order);
    const MOST = 400 * count;
    let last = 0, why = '';
    while (states.length < count && !why) {
      why = orbit.steps > MOST ? 'it does not come back' : orbit.step(Infinity);
      if (why) break;
      const c = orbit.polynomial(system.followed[0], orbit.h);
      for (const s of zeros(c)) {
        const t = orbit.t + s * orbit.h * orbit.unit;
        const rising = value(c, Math.min(1, s + 1e-6)) > value(c, Math.max(0, s - 1e-6));
        if (rising !== section.upwards || t - last < 1e-9 * Math.abs(orbit.unit)) continue;
        last = t;
        const x = orbit.stateAt(s * orbit.h), f = system.functionsAt(t, x);
        places.push(f[section.pair[0]], f[section.pair[1]]);
        states.push(Array.from(x));
      }
      orbit.accept();
      if (!orbit.x.every(Number.isFinite)) why = 'a state is no finite number';
    }
    return {places, states, why};
  }

  let system = null, newest = 0;

  /** Those of the case file, or of the start. */
  const levelsOf = task => system.section.fixed
    || Array.from(system.functionsAt(0, task.state)).slice(0, system.section.levels);

  /** Orbits one after the other; a newer task ends them. */
  async function sectionOf(task) {
    system.prepare(task.parameters);
    const levels = levelsOf(task);
    for (const [index, seed] of task.seeds.entries()) {
      await new Promise(done => setTimeout(done));
      if (newest !== task.id) return;
      system.prepare(task.parameters);
      const start = projected(system, seed, levels, null);
      const orbit = start && crossesWell(system, start) ? crossings(system, start, task.count)
        : {places: [], states: [], why: 'no place on the level'};
      postMessage({id: task.id, kind: 'orbit', index, ...orbit});
    }
    postMessage({id: task.id, kind: 'done'});
  }

  /** The orbit of the state that is seen at a place of the picture, sought from others nearby. */
  function seeded(task) {
    system.prepare(task.parameters);
    const levels = levelsOf(task);
    for (const near of task.near) {
      const start = projected(system, near, levels, task.place);
      if (start && crossesWell(system, start))
        return {start: Array.from(start), ...crossings(system, start, task.count)};
    }
    return {places: [], states: [], why: 'no state of the level was found at this place'};
  }

  let ready = null;

  async function load(task) {
    const made = await WebAssembly.instantiate(task.bytes, {m: Math});
    system = new System(made.instance.exports, task.data);
  }

  onmessage = async message => {
    const task = message.data;
    if (task.kind === 'module') {
      ready = load(task);
      return;
    }
    if (task.kind === 'section') newest = task.id;
    try {
      await ready;
      if (task.kind === 'motion') postMessage({id: task.id, kind: 'motion', ...motion(system, task)});
      else if (task.kind === 'seed') postMessage({id: task.id, kind: 'orbit', index: -1, ...seeded(task)});
      else await sectionOf(task);
    } catch (problem) {
      postMessage({id: task.id, kind: 'problem', words: String(problem)});
    }
  };
}
