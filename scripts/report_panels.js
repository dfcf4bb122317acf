// Whether pictures of a report that show the same thing agree to 1e-6 of its range, with one
// another and with the JSON of the same run. Values are read from the curves as they are drawn; runs
// in the page, loaded by report_checks.js.
'use strict';
const PART = 1e-6;     // of a range
const ROUNDED = 6e-3;  // of a number that is shown with 3 digits

/** The value at a part of an axis: "LOW HIGH" or "LOW HIGH log". */
function axis(text) {
  const [low, high, kind] = text.split(' ');
  return kind ? part => low * Math.pow(high / low, part) : part => +low + part * (high - low);
}

/** Values [x, y] of a curve. */
function valuesOf(path, plot) {
  const [left, top, width, height] = plot.dataset.box.split(' ').map(Number);
  const x = axis(plot.dataset.x), y = axis(plot.dataset.y);
  return (path.getAttribute('d').match(/-?[\d.]+,-?[\d.]+/g) || []).map(one => {
    const [across, down] = one.split(',').map(Number);
    return [x((across - left) / width), y(1 - (down - top) / height)];
  });
}

function span(points, k) {
  const all = points.map(one => one[k]);
  return Math.max(...all) - Math.min(...all);
}

function rms(points) {
  return Math.sqrt(points.reduce((sum, one) => sum + one[1] * one[1], 0) / points.length);
}

/** Curves of each picture by the names of their series, pictures by their titles. */
function picturesOf(page) {
  const pictures = new Map();
  for (const svg of page.querySelectorAll('svg.lines:not(.narrow)')) {
    const plot = svg.querySelector('.plot'), curves = new Map();
    for (const path of plot.querySelectorAll('path[data-series]'))
      curves.set(path.dataset.label, valuesOf(path, plot));
    pictures.set(svg.querySelector('title').textContent, curves);
  }
  return pictures;
}

/** Of these the ones "STATE: what ..." by their states. */
function byState(pictures, what) {
  const found = [...pictures].filter(([title]) => title.includes(': ' + what));
  return new Map(found.map(([title, curves]) => [title.split(': ' + what)[0], curves]));
}

/** What a model is off is the measured value minus the model's, and its rms that of the legend. */
function compareDeviations(shown, left, same) {
  for (const [state, curves] of left)
    for (const [name, off] of curves) {
      const [, model, size] = name.match(/^(.*), rms (.*)$/);
      const measured = shown.get(state).get('measured'), run = shown.get(state).get(model);
      const near = PART * span(off, 0), range = Math.max(span(measured, 1), span(run, 1));
      let i = 0, j = 0, here = 0;
      for (const [time, value] of off) {
        while (i < measured.length && measured[i][0] < time - near) ++i;
        while (j < run.length && run[j][0] < time - near) ++j;
        if (i === measured.length || j === run.length) break;
        if (measured[i][0] > time + near || run[j][0] > time + near) continue;
        same(`${state} of ${model} at ${time}`, measured[i][1] - run[j][1], value, range);
        ++here;
      }
      same(`values of ${state} of ${model}, at least`, Math.min(here, 20), 20, 1);
      same(`rms of ${state} of ${model}`, rms(off), +size, +size, ROUNDED);
    }
}

/** Every point of the excerpt lies on the orbit. @param {number[]} ranges of its states. */
function compareOrbit(shown, points, name, ranges, same) {
  const states = [...shown.values()].slice(0, ranges.length).map(curves => curves.get(name));
  states[0].forEach(([time], i) => {
    const off = point => Math.max(
        ...ranges.map((range, k) => Math.abs(point[k] - states[k][i][1]) / range));
    same(`${name}: the orbit at ${time}`, Math.min(...points.map(off)), 0, 1);
  });
}

function compareOrbits(page, pictures, shown, same) {
  const plane = pictures.get('Orbit') || new Map();
  const ranges = [0, 1].map(k => Math.max(...[...plane.values()].map(curve => span(curve, k))));
  for (const [name, points] of plane) compareOrbit(shown, points, name, ranges, same);
  for (const path of page.querySelectorAll('svg.orbit:not(.narrow) path[data-points]')) {
    const ends = path.dataset.ranges.split(' ').map(Number);
    const sizes = [0, 1, 2].map(k => ends[2 * k + 1] - ends[2 * k]);
    const points = path.dataset.points.split(' ').filter(one => one !== '-').map(
        one => one.split(',').map((u, k) => ends[2 * k] + (+u + 1000) / 2000 * sizes[k]));
    compareOrbit(shown, points, path.dataset.label, sizes, same);
  }
}

/** The distance of a slave is what it is off in all states together. */
function compareDistance(pictures, left, same) {
  const distance = pictures.get('Distance of the slave from the record');
  if (!distance) return;
  const offs = [...left.values()].map(curves => [...curves.values()][0]);
  const [points] = distance.values(), near = PART * span(points, 0);
  const range = span(points.map(one => [0, Math.log(one[1])]), 1);
  // Where the distance is small, what the pictures of its parts round off is large beside it.
  const lost = 2 * Math.max(...offs.map(off => span(off, 1)));
  for (const [time, value] of points) {
    const at = offs.map(off => off.find(one => Math.abs(one[0] - time) < near));
    const sum = Math.hypot(...at.map(one => one[1]));
    same(`distance at ${time}`, Math.log(value), Math.log(sum), Math.max(range, lost / value));
  }
}

/** The JSON of the same run has what is drawn. */
function compareAnswer(answer, pictures, left, same) {
  for (const one of Array.isArray(answer.fit) && answer.fit[0].rmse ? answer.fit : []) {
    const [, curves] = [...left].find(([state]) => state.split(' ')[0] === one.channel);
    const [off] = curves.values();
    same(`rmse of ${one.channel}`, rms(off), one.rmse, span(off, 1));
  }
  const times = answer.input ? answer.input.time : [];
  for (const [name, wanted] of Object.entries(answer.input ? answer.input.values : {})) {
    const drawn = pictures.get(`Input ${name}`).get(name), near = PART * times[times.length - 1];
    times.forEach((time, i) => {
      const off = drawn.filter(([at]) => Math.abs(at - time) <= near).map(
          one => Math.abs(one[1] - wanted[i]));
      same(`${name} at ${time}`, Math.min(...off), 0, span(drawn, 1));
    });
  }
}

/** Faults, and how many values were compared. @param {object} answer the JSON of the same run. */
function comparePanels(answer) {
  const faults = [];
  let compared = 0;
  const same = (what, found, wanted, range, part = PART) => {
    ++compared;
    if (!(Math.abs(found - wanted) <= part * range))
      faults.push(`panels disagree: ${what}: ${found} and ${wanted} in a range of ${range}`);
  };
  const pictures = picturesOf(document);
  const shown = byState(pictures, 'measured and modelled');
  const left = byState(pictures, 'measured minus model');
  compareDeviations(shown, left, same);
  compareOrbits(document, pictures, shown, same);
  compareDistance(pictures, left, same);
  compareAnswer(answer, pictures, left, same);
  if (compared < 50) faults.push(`panels: only ${compared} values are compared`);
  return {faults: faults.slice(0, 10), compared};
}
