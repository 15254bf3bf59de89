// Pictures that gnuplot drew tell their values and zoom. What is known of the axes stands in the
// attribute data-axes: left, right, bottom and top of the frame in the units of the picture, counted
// from its lower edge; the values there; and whether the axes are logarithmic.
const svgNode = (name, attributes, parent) => {
  const node = document.createElementNS('http://www.w3.org/2000/svg', name);
  for (const [key, value] of Object.entries(attributes)) node.setAttribute(key, value);
  if (parent) parent.append(node);
  return node;
};

const htmlNode = (name, properties = {}, ...children) => {
  const node = Object.assign(document.createElement(name), properties);
  node.append(...children);
  return node;
};

/** A number as it is told: with no more digits than a picture has. */
const shortNumber = x => {
  if (x === 0) return '0';
  const size = Math.abs(x);
  const text = size >= 1e5 || size < 1e-3 ? x.toExponential(3) : x.toPrecision(5);
  return (text.includes('.') ? text.replace(/\.?0+(e|$)/, '$1') : text).replace(/^-/, '\u2212');
};

/** Round values between two, some five of them. */
function roundValues(from, to, logarithmic) {
  const low = Math.min(from, to), high = Math.max(from, to);
  if (logarithmic && high / low >= 10) {
    const first = Math.ceil(Math.log10(low) - 1e-9), last = Math.floor(Math.log10(high) + 1e-9);
    const step = Math.max(1, Math.ceil((last - first) / 6)), list = [];
    for (let k = first; k <= last; k += step) list.push(10 ** k);
    return list;
  }
  const rough = (high - low) / 5, power = 10 ** Math.floor(Math.log10(rough));
  const step = power * [1, 2, 5, 10].find(x => x * power >= rough), list = [];
  for (let k = Math.ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k) list.push(k * step);
  return list;
}

/** The axis of a picture: between its units and values. */
class PlotAxis {
  constructor(from, to, low, high, logarithmic) {
    Object.assign(this, {from, to, logarithmic});
    this.low = logarithmic ? Math.log(low) : low;
    this.high = logarithmic ? Math.log(high) : high;
  }
  value(at) {
    const x = this.low + (at - this.from) / (this.to - this.from) * (this.high - this.low);
    return this.logarithmic ? Math.exp(x) : x;
  }
  at(value) {
    const x = this.logarithmic ? Math.log(value) : value;
    return this.from + (x - this.low) / (this.high - this.low) * (this.to - this.from);
  }
  part(from, to) {
    return new PlotAxis(this.from, this.to, this.value(from), this.value(to), this.logarithmic);
  }
}

/** The curves of a picture, as points in its units: those in the frame. */
function curvesOf(svg, inside) {
  return [...svg.querySelectorAll('g[id*="gnuplot_plot_"]')].map(group => {
    const points = [];
    const add = (x, y) => { if (inside(x, y)) points.push([x, y]); };
    for (const path of group.querySelectorAll('path'))
      for (const [, x, y] of path.getAttribute('d').matchAll(/[ML]\s*(-?[\d.]+)[ ,](-?[\d.]+)/g)) add(+x, +y);
    for (const mark of group.querySelectorAll('use')) {
      const place = /translate\((-?[\d.]+)[ ,]+(-?[\d.]+)/.exec(mark.getAttribute('transform') || '');
      if (place) add(+place[1], +place[2]);
      else if (mark.hasAttribute('x')) add(+mark.getAttribute('x'), +mark.getAttribute('y'));
    }
    return {group, points, name: group.querySelector('title')?.textContent || ''};
  }).filter(curve => curve.points.length > 0);
}

class PlotView {
  constructor(svg) {
    const n = svg.dataset.axes.split(' ').map(Number), height = svg.viewBox.baseVal.height;
    this.svg = svg;
    svg.dataset.view = '';
    this.x = new PlotAxis(n[0], n[1], n[4], n[5], n[8] === 1);
    this.y = new PlotAxis(height - n[2], height - n[3], n[6], n[7], n[9] === 1);
    this.whole = [this.x, this.y];
    const inside = (x, y) => x >= n[0] - 1 && x <= n[1] + 1 && y <= height - n[2] + 1 && y >= height - n[3] - 1;
    this.inside = inside;
    this.curves = curvesOf(svg, inside);
    if (this.curves.length === 0) return;
    this.figure = svg.parentElement;
    this.figure.classList.add('told');
    this.tip = htmlNode('output', {className: 'tip', hidden: true});
    this.back = htmlNode('button', {type: 'button', className: 'back', textContent: 'whole picture', hidden: true});
    this.back.addEventListener('click', () => this.zoom(...this.whole));
    this.figure.append(this.tip, this.back);
    svg.addEventListener('pointermove', event => this.move(event));
    svg.addEventListener('pointerdown', event => this.down(event));
    svg.addEventListener('pointerup', event => this.up(event));
    svg.addEventListener('pointerleave', () => this.hide());
    svg.addEventListener('pointercancel', () => this.hide());
    svg.addEventListener('dblclick', () => this.zoom(...this.whole));
  }

  place(event) {
    const point = new DOMPoint(event.clientX, event.clientY).matrixTransform(this.svg.getScreenCTM().inverse());
    return [point.x, point.y];
  }

  /** Where a point of the whole picture is now. */
  shown([x, y]) {
    const [wholeX, wholeY] = this.whole;
    return [this.x.at(wholeX.value(x)), this.y.at(wholeY.value(y))];
  }

  hide() {
    this.tip.hidden = true;
    this.dot?.remove();
    this.frame?.remove();
    this.dot = this.frame = this.start = null;
  }

  move(event) {
    const [x, y] = this.place(event);
    if (this.start) return this.drag(x, y);
    let best = null, least = 40 ** 2;
    for (const curve of this.curves)
      for (const point of curve.points) {
        const [a, b] = this.shown(point), apart = (a - x) ** 2 + (b - y) ** 2;
        if (apart < least && this.inside(a, b)) [best, least] = [{curve, a, b}, apart];
      }
    if (!best) return this.hide();
    const {curve, a, b} = best;
    this.dot ??= svgNode('circle', {r: 4, fill: 'none', stroke: 'var(--plot-ink)', 'stroke-width': 2}, this.svg);
    this.dot.setAttribute('cx', a);
    this.dot.setAttribute('cy', b);
    const name = curve.name.startsWith('gnuplot_plot') ? '' : curve.name + ': ';
    this.tip.textContent = `${name}${shortNumber(this.x.value(a))}, ${shortNumber(this.y.value(b))}`;
    this.tip.hidden = false;
    const box = this.figure.getBoundingClientRect();
    const left = event.clientX - box.left, width = this.tip.offsetWidth;
    this.tip.style.left = `${Math.max(0, Math.min(left + 12, box.width - width))}px`;
    this.tip.style.top = `${event.clientY - box.top - 34}px`;
  }

  down(event) {
    const [x, y] = this.place(event);
    if (event.pointerType === 'touch' || event.button !== 0 || !this.inside(x, y)) return this.move(event);
    this.hide();
    this.start = [x, y];
    this.svg.setPointerCapture(event.pointerId);
    event.preventDefault();
  }

  drag(x, y) {
    const [a, b] = this.start;
    this.frame ??= svgNode('rect', {fill: 'var(--plot-1)', 'fill-opacity': 0.15, stroke: 'var(--plot-1)'}, this.svg);
    const set = (key, value) => this.frame.setAttribute(key, value);
    set('x', Math.min(a, x));
    set('y', Math.min(b, y));
    set('width', Math.abs(x - a));
    set('height', Math.abs(y - b));
  }

  up(event) {
    if (!this.start) return;
    const [x, y] = this.place(event), [a, b] = this.start;
    this.hide();
    const within = (axis, at) => Math.min(Math.max(at, Math.min(axis.from, axis.to)), Math.max(axis.from, axis.to));
    if (Math.abs(x - a) < 8 || Math.abs(y - b) < 8) return;
    const [left, right] = [a, x].map(at => within(this.x, at)).sort((p, q) => p - q);
    const [top, bottom] = [b, y].map(at => within(this.y, at)).sort((p, q) => p - q);
    this.zoom(this.x.part(left, right), this.y.part(bottom, top));
  }

  zoom(x, y) {
    [this.x, this.y] = [x, y];
    this.drawn?.remove();
    const whole = x === this.whole[0] && y === this.whole[1];
    this.back.hidden = whole;
    for (const mark of this.svg.querySelectorAll(':scope > g g > path + g')) {
      const tick = mark.parentElement;
      if (!tick.closest('[id*="gnuplot_plot_"]')) tick.style.display = whole ? '' : 'none';
    }
    for (const {group} of this.curves) this.keep(group, whole);
    if (!whole) this.draw();
  }

  /** Of a curve, the entry of the legend, or all of it again. */
  keep(group, whole) {
    for (const path of group.querySelectorAll('path')) {
      path.dataset.whole ??= path.getAttribute('d');
      const outside = path.dataset.whole.match(/M[^M]*/g)?.filter(part => {
        const [, px, py] = /M\s*(-?[\d.]+)[ ,](-?[\d.]+)/.exec(part);
        return !this.inside(+px, +py);
      });
      path.setAttribute('d', whole ? path.dataset.whole : (outside || []).join(' ') || 'M0,0');
    }
    for (const mark of group.querySelectorAll('use')) {
      const place = /translate\((-?[\d.]+)[ ,]+(-?[\d.]+)/.exec(mark.getAttribute('transform') || '');
      if (place && this.inside(+place[1], +place[2])) mark.style.display = whole ? '' : 'none';
    }
  }

  draw() {
    const {x, y, svg} = this, id = `clip-${svg.parentElement.id}-${[...document.querySelectorAll('svg')].indexOf(svg)}`;
    this.drawn = svgNode('g', {'font-size': 13, 'font-family': 'sans-serif', fill: 'var(--plot-ink)'}, svg);
    const clip = svgNode('clipPath', {id}, this.drawn);
    svgNode('rect', {x: x.from, y: y.to, width: x.to - x.from, height: y.from - y.to}, clip);
    for (const value of roundValues(x.value(x.from), x.value(x.to), x.logarithmic)) {
      svgNode('path', {d: `M${x.at(value)},${y.from}V${y.to}`, stroke: 'var(--plot-grid)'}, this.drawn);
      svgNode('text', {x: x.at(value), y: y.from + 20, 'text-anchor': 'middle'}, this.drawn).textContent = shortNumber(value);
    }
    for (const value of roundValues(y.value(y.from), y.value(y.to), y.logarithmic)) {
      svgNode('path', {d: `M${x.from},${y.at(value)}H${x.to}`, stroke: 'var(--plot-grid)'}, this.drawn);
      svgNode('text', {x: x.from - 6, y: y.at(value) + 4, 'text-anchor': 'end'}, this.drawn).textContent = shortNumber(value);
    }
    const inner = svgNode('g', {'clip-path': `url(#${id})`, fill: 'none'}, this.drawn);
    for (const {group} of this.curves) {
      for (const path of group.querySelectorAll('path')) {
        const moved = path.dataset.whole.match(/M[^M]*/g)?.filter(part => {
          const [, px, py] = /M\s*(-?[\d.]+)[ ,](-?[\d.]+)/.exec(part);
          return this.inside(+px, +py);
        }).map(part => part.replace(/(-?[\d.]+)[ ,](-?[\d.]+)/g,
          (_, px, py) => this.shown([+px, +py]).map(v => v.toFixed(2)).join(',')));
        if (!moved?.length) continue;
        const copy = svgNode('path', {d: moved.join(' ')}, inner);
        for (const key of ['stroke', 'stroke-dasharray', 'stroke-width'])
          if (path.closest(`[${key}]`)) copy.setAttribute(key, path.closest(`[${key}]`).getAttribute(key));
      }
      for (const mark of group.querySelectorAll('use')) {
        const place = /translate\((-?[\d.]+)[ ,]+(-?[\d.]+)\)(.*)/.exec(mark.getAttribute('transform') || '');
        if (!place || !this.inside(+place[1], +place[2])) continue;
        const copy = mark.cloneNode();
        const [a, b] = this.shown([+place[1], +place[2]]);
        copy.style.display = '';
        copy.setAttribute('transform', `translate(${a},${b})${place[3]}`);
        inner.append(copy);
      }
    }
  }
}

// The pictures that stand in the page: they come after the script.
document.addEventListener('DOMContentLoaded', () => {
  for (const svg of document.querySelectorAll('figure svg[data-axes]:not([data-view])')) new PlotView(svg);
});
