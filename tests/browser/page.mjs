// Drives the report of `monge test` in Chromium: node page.mjs PACKAGES INDEX.html SHOTS
// The run that it shows is that of tests/page.sh. Ends with `N passed, N failed`.
import {createRequire} from 'node:module';
import {existsSync} from 'node:fs';
import path from 'node:path';
import {pathToFileURL} from 'node:url';

const [packages, page, shots] = process.argv.slice(2);
const {chromium} = createRequire(path.resolve(packages, 'package.json'))('playwright-core');
const executablePath = ['/usr/bin/chromium', '/usr/bin/chromium-browser'].find(existsSync);
let passed = 0, failed = 0;

function check(what, good, found) {
  if (good) passed++;
  else {
    failed++;
    console.log(`FAILED: ${what}${found === undefined ? '' : `: ${JSON.stringify(found)}`}`);
  }
}

const browser = await chromium.launch({executablePath, args: ['--no-sandbox']});

async function open(options) {
  const context = await browser.newContext({viewport: {width: 1280, height: 860}, reducedMotion: 'reduce', ...options});
  const tab = await context.newPage();
  tab.trouble = [];
  tab.on('pageerror', (error) => tab.trouble.push(error.message));
  tab.on('console', (message) => { if (message.type() === 'error') tab.trouble.push(message.text()); });
  tab.on('request', (request) => { if (!/^(file|blob|data):/.test(request.url()) || (/^file:/.test(request.url()) && !request.url().includes('index.html'))) tab.trouble.push(`asks for ${request.url()}`); });
  await tab.goto(pathToFileURL(path.resolve(page)).href);
  await tab.waitForSelector('#detail h2');
  return tab;
}

const rows = (tab) => tab.$$eval('#list li', (list) => list.map((row) => row.dataset.name));
const title = (tab) => tab.textContent('#detail h2');
const body = (tab) => tab.textContent('#detail');
const shown = async (tab, name) => tab.waitForFunction((want) => document.querySelector('#detail h2')?.textContent === want, name, {timeout: 5000}).then(() => true, () => false);
/* Until the scene, the mode and the pass are those that are wanted. */
const settled = (tab, wanted) => tab.waitForFunction((want) => document.querySelector('#detail').dataset.shows === want, wanted, {timeout: 5000});
const transform = (tab) => tab.$eval('.stage canvas', (canvas) => canvas.style.transform);
const shot = (tab, name) => tab.screenshot({path: path.join(shots, `${name}.png`)});

/* Points at a pixel of the picture in the first stage, and gives what is told of it. */
async function pointAt(tab, x, y) {
  const box = await tab.$eval('.stage canvas', (canvas) => {
    const {left, top, width} = canvas.getBoundingClientRect();
    return {left, top, scale: width / canvas.width};
  });
  await tab.mouse.move(box.left + (x + 0.5) * box.scale, box.top + (y + 0.5) * box.scale);
  return tab.textContent('#values');
}

const tab = await open({colorScheme: 'light'});
check('all scenes, what needs a look first', (await rows(tab)).join() === 'moved,painted,bad,fresh,still', await rows(tab));
check('the first is shown', await title(tab) === 'moved', await title(tab));
check('three panes side by side', (await tab.$$('.stage')).length === 3);
check('what changed is told', /geometry moved/.test(await body(tab)), await body(tab));
check('the command is there', /monge render .*moved\.yaml/.test(await body(tab)));
check('so is that which takes the new picture', /monge accept --golden \S+ .*moved/.test(await body(tab)), await body(tab));
check('the pixels are counted', /pixels[\d,]+ of [\d,]+/.test(await body(tab)), await body(tab));
await shot(tab, 'side');

const passes = await tab.$$eval('select[aria-label="What is shown"] option', (options) => options.map((option) => option.value));
check('the passes can be chosen', ['colour', 'object', 'depth', 'normal'].every((name) => passes.includes(name)), passes);
for (const name of passes.slice(1)) {
  await tab.selectOption('select[aria-label="What is shown"]', name);
  await settled(tab, `moved side ${name}`);
  const colours = await tab.$eval('.stage canvas', (canvas) => new Set(new Uint32Array(canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height).data.buffer)).size);
  check(`there is something in the pass ${name}`, colours > 1, colours);
  if (name === 'normal') await shot(tab, 'normal');
}
await tab.selectOption('select[aria-label="What is shown"]', 'object');
await settled(tab, 'moved side object');
const object = await pointAt(tab, 30, 20);
check('the number of an object is told', /golden +1$/m.test(object), object);
await tab.selectOption('select[aria-label="What is shown"]', 'colour');
await settled(tab, 'moved side colour');

await tab.keyboard.press('j');
check('j goes on', await shown(tab, 'painted'));
check('its change is the material', /shading changed, geometry equal: another material/.test(await body(tab)), await body(tab));
await tab.keyboard.press('j');
check('a broken scene', await shown(tab, 'bad') && /unknown-key/.test(await body(tab)));
await tab.keyboard.press('k');
await shown(tab, 'painted');

/* The golden is #203040 behind everything, the new one #204060. */
await tab.keyboard.press('s');
await settled(tab, 'painted side colour');
const told = await pointAt(tab, 1, 1);
check('values of the golden', /golden +32 +48 +64/.test(told), told);
check('values of the new one', /new +32 +64 +96/.test(told), told);
check('how far apart they are', /apart +0 +16 +32/.test(told), told);

const before = await transform(tab);
await tab.mouse.wheel(0, -240);
check('the wheel zooms', await transform(tab) !== before);
const away = await transform(tab);
await tab.mouse.down();
await tab.mouse.move(500, 400);
await tab.mouse.up();
check('dragging moves', await transform(tab) !== away);
await tab.keyboard.press('0');
check('0 fits again', await transform(tab) === before, [before, await transform(tab)]);
await tab.keyboard.press('1');
check('1 is one to one', /scale\(1\)/.test(await transform(tab)), await transform(tab));
await tab.keyboard.press('0');

await tab.click('[data-mode=slide]');
await settled(tab, 'painted slide colour');
const clip = () => tab.$eval('.stage canvas:nth-of-type(2)', (canvas) => canvas.style.clipPath);
const middle = await clip(), handle = await (await tab.$('.cut')).boundingBox();
await tab.mouse.move(handle.x + 1, handle.y + handle.height / 2);
await tab.mouse.down();
await tab.mouse.move(handle.x + 150, handle.y + handle.height / 2);
await tab.mouse.up();
check('the slider uncovers', await clip() !== middle, middle);
await shot(tab, 'slider');

await tab.keyboard.press('b');
await settled(tab, 'painted blink colour');
const caption = () => tab.textContent('.pane figcaption');
const one = await caption();
await tab.keyboard.press(' ');
check('space steps while it blinks', await caption() !== one, one);

/* Equal pixels are black in the difference, and dim in the heat map. */
const seen = (x, y) => tab.$eval('.stage canvas', (canvas, at) => Array.from(canvas.getContext('2d').getImageData(at[0], at[1], 1, 1).data), [x, y]);
await tab.keyboard.press('d');
await settled(tab, 'painted difference colour');
check('the difference times 8', (await seen(1, 1)).join() === '0,128,255,255', await seen(1, 1));
await tab.keyboard.press('h');
await settled(tab, 'painted heat colour');
const heat = await seen(1, 1);
check('the heat map is warm there', heat[0] > heat[1] + 30, heat);
await shot(tab, 'heat');

await tab.click('[data-filter=same]');
check('the filter leaves those of its status', (await rows(tab)).join() === 'still' && await shown(tab, 'still'), await rows(tab));
check('a picture that is the same is there once', (await tab.$$('.stage')).length >= 1);
await tab.click('[data-filter=all]');
await tab.keyboard.press('/');
await tab.keyboard.type('fre');
check('the search finds', (await rows(tab)).join() === 'fresh' && await shown(tab, 'fresh'), await rows(tab));
await tab.keyboard.press('Enter');
check('a new scene has one picture', (await tab.$$('.stage')).length === 1);
await tab.fill('#search', 'no such name');
check('nothing found is said', /no such scene/.test(await tab.textContent('#list')));
await tab.fill('#search', '');

const paper = () => tab.$eval('body', (element) => getComputedStyle(element).backgroundColor);
const light = await paper();
await tab.keyboard.press('Escape');
await tab.keyboard.press('t');
check('t turns light to dark', await paper() !== light, light);
await tab.keyboard.press('?');
check('? shows the keys', await tab.$eval('#help', (dialog) => dialog.open));
await tab.keyboard.press('Escape');
check('nothing went wrong, nothing was fetched', tab.trouble.length === 0, tab.trouble);

const dark = await open({colorScheme: 'dark'});
check('dark where the system is', await dark.$eval('html', (html) => html.dataset.theme) === 'dark');
await shot(dark, 'dark');
const narrow = await open({viewport: {width: 420, height: 800}});
check('a narrow window does not scroll sideways', await narrow.evaluate(() => document.documentElement.scrollWidth <= innerWidth), await narrow.evaluate(() => document.documentElement.scrollWidth));
await shot(narrow, 'narrow');

await browser.close();
console.log(`${passed} passed, ${failed} failed`);
process.exit(failed ? 1 : 0);
