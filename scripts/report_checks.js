// What a browser finds in pages: one line for each fault, status 1 where there is one.
// Usage: node report_checks.js PAGE.html...   (axe-core and puppeteer-core in NODE_PATH; beside a
// page its answer, PAGE.json; pictures go to PAGE_WIDTH.png where SCREENSHOTS is set)
'use strict';
const fs = require('fs');
const path = require('path');
const puppeteer = require('puppeteer-core');
const axe = fs.readFileSync(require.resolve('axe-core/axe.min.js'), 'utf8');

const CHROMIUM = process.env.CHROMIUM || '/usr/bin/chromium';

/** Violations that axe-core calls serious or critical. */
async function violations(page) {
  await page.evaluate(axe);
  const found = await page.evaluate(() => window.axe.run(document));
  return found.violations
      .filter(one => one.impact === 'serious' || one.impact === 'critical')
      .map(one => `axe ${one.id}: ${one.help}; ${one.nodes.length} places, first ` +
          one.nodes[0].html.slice(0, 120));
}

/** What can be seen without axe-core; runs in the page, with everything unfolded. */
function seen() {
  const faults = [];
  document.querySelectorAll('details').forEach(one => { one.open = true; });
  if (document.documentElement.scrollWidth > innerWidth)
    faults.push(`it scrolls sideways: ${document.documentElement.scrollWidth} in ${innerWidth}`);
  for (const term of document.querySelectorAll('.equations .term')) {
    const line = term.parentElement.getBoundingClientRect();
    for (const piece of term.querySelectorAll('math'))
      if (piece.getBoundingClientRect().right > line.right + 1)
        faults.push(`a term is cut: '${term.textContent.trim()}'`);
  }

  // Texts of one picture do not lie on each other; half a pixel is rounding.
  const overlap = (a, b) => Math.min(a.right, b.right) - Math.max(a.left, b.left) > 0.5 &&
      Math.min(a.bottom, b.bottom) - Math.max(a.top, b.top) > 0.5 * Math.min(a.height, b.height);
  for (const svg of document.querySelectorAll('svg')) {
    const frame = svg.getBoundingClientRect();
    const texts = [...svg.querySelectorAll('text')].map(one => [one.textContent,
      one.getBoundingClientRect()]).filter(([, box]) => box.width > 0);
    texts.forEach(([name, box], i) => {
      if (box.left < frame.left - 1 || box.right > frame.right + 1)
        faults.push(`text leaves its picture: '${name}'`);
      for (const [other, its] of texts.slice(i + 1))
        if (overlap(box, its)) faults.push(`texts overlap: '${name}' and '${other}'`);
    });
  }

  // Text and what lies behind it, in pictures too, which axe-core leaves out.
  const numbers = colour => colour.match(/[\d.]+/g).map(Number);
  const light = colour => {
    const [r, g, b] = numbers(colour).map(c => c / 255)
        .map(c => c <= 0.04045 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4);
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
  };
  const behind = element => {
    for (let at = element; at; at = at.parentElement) {
      const colour = getComputedStyle(at).backgroundColor;
      if (numbers(colour)[3] !== 0) return colour;
    }
    return 'rgb(255, 255, 255)';
  };
  const poor = new Set();
  for (const element of document.querySelectorAll('main *, footer')) {
    const own = [...element.childNodes].some(n => n.nodeType === 3 && n.data.trim());
    if (!own || !element.getClientRects().length) continue;
    const style = getComputedStyle(element);
    const svg = element.closest('svg');
    const ink = light(svg ? style.fill : style.color), paper = light(behind(svg || element));
    const contrast = (Math.max(ink, paper) + 0.05) / (Math.min(ink, paper) + 0.05);
    if (contrast < 4.5) poor.add(`contrast ${contrast.toFixed(2)}: ${element.tagName}.` +
        `${element.getAttribute('class') || ''}`);
  }
  return [...faults, ...poor];
}

/** Whether Tab comes to all that answers a click, and Enter does there what a click does. */
async function keyboard(page) {
  const wanted = await page.evaluate(() => {
    document.querySelectorAll('details').forEach(one => { one.open = true; });
    const all = [...document.querySelectorAll('.key, summary, svg.orbit, a[href], button')]
        .filter(one => one.getClientRects().length);
    all.forEach((one, i) => { one.dataset.reach = i; });
    return all.length;
  });
  const reached = new Set();
  for (let i = 0; i < 2 * wanted + 20; ++i) {
    await page.keyboard.press('Tab');
    reached.add(await page.evaluate(() => document.activeElement.dataset.reach));
  }
  reached.delete(undefined);
  const faults = reached.size < wanted ? [`Tab comes to ${reached.size} of ${wanted}`] : [];
  const hidden = await page.evaluate(() => {
    const key = document.querySelector('.lines .key');
    if (!key) return true;
    key.focus();
    key.dispatchEvent(new KeyboardEvent('keydown', {key: 'Enter', bubbles: true}));
    const curve = key.closest('svg').querySelector(`path[data-series="${key.dataset.series}"]`);
    return curve.style.display === 'none';
  });
  if (!hidden) faults.push('Enter on a name hides no curve');
  const seen_now = () => page.evaluate(() => {
    const orbit = document.querySelector('svg.orbit');
    if (orbit) orbit.focus();
    return orbit && orbit.querySelector('path[data-points]').getAttribute('d');
  });
  for (const arrow of ['ArrowRight', 'ArrowUp']) {
    const before = await seen_now();
    await page.keyboard.press(arrow);
    if (before && before === await seen_now()) faults.push(`${arrow} does not turn the orbit`);
  }
  return faults;
}

/** Whether pictures that show the same thing agree; says how much was compared. */
async function panels(page, file) {
  const answer = JSON.parse(fs.readFileSync(file.replace(/html$/, 'json'), 'utf8'));
  await page.evaluate(fs.readFileSync(path.join(__dirname, 'report_panels.js'), 'utf8') +
                      ';window.comparePanels = comparePanels;');
  const found = await page.evaluate(one => window.comparePanels(one), answer);
  console.log(`${path.basename(file)}: ${found.compared} values of its pictures compared`);
  return found.faults;
}

(async () => {
  const browser = await puppeteer.launch(
      {executablePath: CHROMIUM, args: ['--no-sandbox', '--disable-gpu']});
  let count = 0;
  for (const file of process.argv.slice(2)) {
    for (const width of [390, 1400]) {
      for (const scheme of ['light', 'dark']) {
        const page = await browser.newPage();
        await page.setViewport({width, height: 900});
        await page.emulateMediaFeatures([{name: 'prefers-color-scheme', value: scheme}]);
        await page.goto('file://' + path.resolve(file));
        if (process.env.SCREENSHOTS && scheme === 'light')
          await page.screenshot({path: file.replace(/\.html$/, `_${width}.png`), fullPage: true});
        const faults = [...await page.evaluate(seen), ...await violations(page)];
        if (width === 1400 && scheme === 'light')
          faults.push(...await panels(page, file), ...await keyboard(page));
        for (const fault of faults)
          console.log(`${path.basename(file)}, ${width} px, ${scheme}: ${fault}`);
        count += faults.length;
        await page.close();
      }
    }
  }
  await browser.close();
  console.log(`${process.argv.length - 2} pages, ${count} faults`);
  process.exit(count ? 1 : 0);
})();
