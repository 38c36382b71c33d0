'use strict';

/* ---- What there is to show ---- */

const results = JSON.parse(document.getElementById('results').textContent);
const STATUSES = ['changed', 'broken', 'missing', 'new', 'orphan', 'same'];
const MODES = [
  ['side', 'Side by side', 's'], ['slide', 'Slider', 'l'], ['blink', 'Blink', 'b'],
  ['difference', 'Difference', 'd'], ['heat', 'Heat map', 'h'],
];
const scenes = results.scenes
  .map((scene, index) => ({...scene, index}))
  .sort((a, b) => STATUSES.indexOf(a.status) - STATUSES.indexOf(b.status) || a.index - b.index);

const state = {
  filter: 'all', search: '', scene: null, mode: 'side', layer: 'colour', gain: 8, cut: 0.5, showsNew: true,
  zoom: 1, left: 0, top: 0, fitted: true,
};
let view = null; // the pictures of the scene that is shown, and their stages
let blinking = 0;

const $ = (id) => document.getElementById(id);

/* An element with attributes, or listeners as functions, and children. */
function make(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === 'function') element.addEventListener(name, value);
    else if (value !== null && value !== undefined && value !== false) element.setAttribute(name, value === true ? '' : value);
  }
  element.append(...children.filter((child) => child !== null && child !== undefined));
  return element;
}

/* ---- Pictures: base64 of files in elements of the page, decoded when they are looked at ---- */

const pictures = new Map([...document.querySelectorAll('script.picture')].map((element) => [element.dataset.path, element]));

function bytesOf(path) {
  const element = path && pictures.get(path);
  if (!element) return null;
  return Uint8Array.from(atob(element.textContent.trim()), (c) => c.charCodeAt(0));
}

/* A portable float map: grey by the range of its finite values, the nearest white. */
function decodePfm(bytes) {
  let at = 0;
  const word = () => {
    let text = '';
    while (bytes[at] <= 32) at++;
    while (bytes[at] > 32) text += String.fromCharCode(bytes[at++]);
    return text;
  };
  const channels = word() === 'PF' ? 3 : 1, width = Number(word()), height = Number(word()), little = Number(word()) < 0;
  at++;
  const numbers = new DataView(bytes.buffer, bytes.byteOffset + at);
  const values = Float32Array.from({length: width * height * channels}, (_, i) => numbers.getFloat32(4 * i, little));
  let low = Infinity, high = -Infinity;
  for (const value of values) if (Number.isFinite(value)) { low = Math.min(low, value); high = Math.max(high, value); }
  const image = new ImageData(width, height);
  for (let y = 0; y < height; y++)
    for (let x = 0; x < width; x++)
      for (let c = 0; c < 3; c++) {
        const value = values[((height - 1 - y) * width + x) * channels + (channels === 3 ? c : 0)];
        image.data[4 * (y * width + x) + c] = Number.isFinite(value) ? 255 * (1 - 0.9 * (value - low) / (high - low || 1)) : 0;
        image.data[4 * (y * width + x) + 3] = 255;
      }
  return image;
}

/* The chunks of a PNG file, by the names of those that are wanted; of several of a name all data, joined. */
function chunksOf(bytes, names) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length), parts = Object.fromEntries(names.map((name) => [name, []]));
  for (let at = 8; at + 12 <= bytes.length; at += 12 + view.getUint32(at)) {
    const name = String.fromCharCode(...bytes.subarray(at + 4, at + 8));
    if (names.includes(name)) parts[name].push(bytes.subarray(at + 8, at + 8 + view.getUint32(at)));
  }
  return parts;
}

/* Undoes the filters of the rows, `rows` having a filter byte before each of `stride` bytes; `step` bytes are a pixel. */
function unfilter(rows, stride, step) {
  const out = new Uint8Array(rows.length / (stride + 1) * stride);
  for (let from = 0, to = 0; from < rows.length; from += stride + 1, to += stride)
    for (let i = 0; i < stride; i++) {
      const left = i < step ? 0 : out[to + i - step], up = to ? out[to + i - stride] : 0, corner = to && i >= step ? out[to + i - stride - step] : 0;
      const guess = left + up - corner, far = [Math.abs(guess - left), Math.abs(guess - up), Math.abs(guess - corner)];
      const paeth = far[0] <= far[1] && far[0] <= far[2] ? left : far[1] <= far[2] ? up : corner;
      out[to + i] = rows[from + 1 + i] + [0, left, up, (left + up) >> 1, paeth][rows[from]];
    }
  return out;
}

/* Of 16 bits a channel, which a browser has not: its numbers, with an image of the high bytes; for the numbers of objects and
 * the like, `isNumber`, one of colours that tell them apart. Null: another kind of file. */
async function decode16(bytes, isNumber) {
  const {IHDR: [header], IDAT: data} = chunksOf(bytes, ['IHDR', 'IDAT']);
  const channels = {0: 1, 2: 3, 4: 2, 6: 4}[header[9]];
  if (header[8] !== 16 || header[12] !== 0) return null;
  const size = new DataView(header.buffer, header.byteOffset), width = size.getUint32(0), height = size.getUint32(4);
  const rows = await new Response(new Blob(data).stream().pipeThrough(new DecompressionStream('deflate'))).arrayBuffer();
  const plain = unfilter(new Uint8Array(rows), 2 * channels * width, 2 * channels);
  const image = new ImageData(width, height), numbers = Uint16Array.from({length: plain.length / 2}, (_, i) => plain[2 * i] << 8 | plain[2 * i + 1]);
  for (let i = 0; i < width * height; i++) {
    const at = i * channels, code = numbers[at];
    for (let c = 0; c < 3; c++)
      image.data[4 * i + c] = isNumber ? code && 64 + (code * [97, 57, 173][c] + 60 * c) % 192 : numbers[at + (channels > 2 ? c : 0)] >> 8;
    image.data[4 * i + 3] = channels % 2 ? 255 : numbers[at + channels - 1] >> 8;
  }
  return Object.assign(image, {numbers, channels});
}

async function decode(path) {
  const bytes = bytesOf(path);
  if (!bytes) return null;
  if (bytes[0] === 0x50) return decodePfm(bytes);
  const exact = await decode16(bytes, ['object', 'material', 'shadow'].includes(state.layer));
  if (exact) return exact;
  const bitmap = await createImageBitmap(new Blob([bytes], {type: 'image/png'}), {colorSpaceConversion: 'none', premultiplyAlpha: 'none'});
  const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d', {willReadFrequently: true});
  context.drawImage(bitmap, 0, 0);
  return context.getImageData(0, 0, bitmap.width, bitmap.height);
}

/* The largest difference of a pixel's channels, 0 to 255; a pixel that one of them lacks differs wholly. */
function differenceAt(a, b, x, y) {
  if (x >= a.width || y >= a.height || x >= b.width || y >= b.height) return 255;
  const i = 4 * (y * a.width + x), k = 4 * (y * b.width + x);
  let most = 0;
  for (let c = 0; c < 4; c++) most = Math.max(most, Math.abs(a.data[i + c] - b.data[k + c]));
  return most;
}

function differenceImage(a, b, paint) {
  const width = Math.max(a.width, b.width), height = Math.max(a.height, b.height), image = new ImageData(width, height);
  for (let y = 0, at = 0; y < height; y++)
    for (let x = 0; x < width; x++, at += 4) {
      paint(image.data, at, differenceAt(a, b, x, y), x, y);
      image.data[at + 3] = 255;
    }
  return image;
}

function amplified(a, b) {
  return differenceImage(a, b, (data, at, most, x, y) => {
    const both = x < a.width && y < a.height && x < b.width && y < b.height;
    for (let c = 0; c < 3; c++)
      data[at + c] = both ? state.gain * Math.abs(a.data[4 * (y * a.width + x) + c] - b.data[4 * (y * b.width + x) + c]) : c === 1 ? 0 : 255;
  });
}

/* From black by violet and orange to pale yellow, over the golden picture in dim grey. */
const HEAT = [[10, 8, 30], [80, 18, 123], [182, 54, 121], [251, 136, 97], [252, 253, 191]];
function heated(a, b) {
  return differenceImage(a, b, (data, at, most, x, y) => {
    if (most === 0) {
      const i = 4 * (y * a.width + x);
      data[at] = data[at + 1] = data[at + 2] = 0.12 * (a.data[i] + a.data[i + 1] + a.data[i + 2]);
      return;
    }
    const place = Math.min(1, Math.sqrt(most / 255) * 1.2 + 0.15) * (HEAT.length - 1), low = Math.min(Math.floor(place), HEAT.length - 2);
    for (let c = 0; c < 3; c++) data[at + c] = HEAT[low][c] + (place - low) * (HEAT[low + 1][c] - HEAT[low][c]);
  });
}

function canvasOf(image) {
  const canvas = make('canvas', {width: image.width, height: image.height});
  canvas.getContext('2d').putImageData(image, 0, 0);
  return canvas;
}

/* ---- The list ---- */

const shown = () => scenes.filter((scene) => (state.filter === 'all' || scene.status === state.filter) && scene.name.toLowerCase().includes(state.search));

function drawFilters() {
  const count = (status) => scenes.filter((scene) => scene.status === status).length;
  const button = (name, number) => make('button', {
    type: 'button', 'data-filter': name, 'aria-pressed': String(state.filter === name), click: () => setFilter(name),
  }, `${name} ${number}`);
  $('filters').replaceChildren(button('all', scenes.length), ...STATUSES.filter(count).map((status) => button(status, count(status))));
}

function drawList() {
  const rows = shown().map((scene) => make('li', {
    'data-name': scene.name, 'aria-current': String(scene === state.scene), click: () => showScene(scene),
  }, make('span', {}, scene.name), make('span', {class: `status ${scene.status}`}, scene.status)));
  $('list').replaceChildren(...(rows.length ? rows : [make('li', {class: 'none'}, 'no such scene')]));
}

function setFilter(name) {
  state.filter = name;
  drawFilters();
  drawList();
  if (!shown().includes(state.scene)) showScene(shown()[0] ?? null);
}

function markCurrent() {
  for (const row of $('list').children) {
    const current = row.dataset.name === state.scene?.name;
    row.setAttribute('aria-current', String(current));
    if (current) row.scrollIntoView({block: 'nearest'});
  }
}

function step(by) {
  const list = shown(), at = list.indexOf(state.scene);
  if (list.length) showScene(list[Math.max(0, Math.min(list.length - 1, at + by))]);
}

/* ---- One scene ---- */

const number = (value) => typeof value !== 'number' ? String(value) : Number.isInteger(value) ? value.toLocaleString('en') : value.toPrecision(4);

function metricsTable(scene) {
  const rows = Object.entries(scene.metrics ?? {}).map(([name, value]) => make('tr', {}, make('th', {}, name), make('td', {class: 'number'}, value === null ? 'infinite' : number(value))));
  if (scene.pixels) rows.unshift(make('tr', {}, make('th', {}, 'pixels'), make('td', {class: 'number'}, `${number(scene.pixels.different)} of ${number(scene.pixels.compared)}`)));
  if (scene.tolerance) rows.push(make('tr', {}, make('th', {}, 'allowed'), make('td', {}, `${scene.tolerance.text}: ${scene.tolerance.reason}`)));
  return rows.length ? [make('h3', {}, 'How much'), make('table', {}, ...rows)] : [];
}

function changesList(scene) {
  const what = [...(scene.changes ?? [])];
  const origin = Object.entries(scene.differs ?? {}).filter(([, differs]) => differs).map(([name]) => name);
  if (origin.length) what.push(`since the golden was made, the ${origin.join(' and the ')} changed`);
  else if (scene.differs && scene.status === 'changed') what.push('scene, options and program are those of the golden');
  return what.length ? [make('h3', {}, 'What changed'), make('ul', {class: 'changes'}, ...what.map((text) => make('li', {}, text)))] : [];
}

function commandLines(scene) {
  const copy = (text) => make('button', {type: 'button', title: 'Copy (c)', click: (event) => {
    navigator.clipboard?.writeText(text);
    event.target.textContent = 'Copied';
  }}, 'Copy');
  const commands = [['To see it again', scene.command], ['The old picture', scene.old_command], ['To take the new one as the golden', scene.accept_command]].filter(([, text]) => text);
  return commands.flatMap(([title, text]) => [make('h3', {}, title), make('div', {class: 'command'}, make('pre', {}, text), copy(text))]);
}

const layersOf = (scene) => ['colour', ...Object.keys(scene.layers ?? {})];
const pathsOf = (scene) => state.layer === 'colour' ? scene.pictures ?? {} : scene.layers?.[state.layer] ?? {};

function toolbar(scene, both) {
  const press = (mode, label, key) => make('button', {
    type: 'button', 'data-mode': mode, title: `${label} (${key})`, 'aria-pressed': String(state.mode === mode), click: () => setMode(mode),
  }, label);
  const layers = layersOf(scene);
  const choose = layers.length > 1 ? make('select', {'aria-label': 'What is shown', title: 'What is shown (p)', change: (event) => setLayer(event.target.value)},
    ...layers.map((name) => make('option', {value: name, selected: name === state.layer}, name))) : null;
  const gain = make('select', {'aria-label': 'Difference times', change: (event) => { state.gain = Number(event.target.value); showScene(state.scene); }},
    ...[1, 8, 64].map((times) => make('option', {value: times, selected: times === state.gain}, `difference x ${times}`)));
  return make('div', {class: 'bar'}, ...(both ? MODES.map((mode) => press(...mode)) : []), choose, both ? gain : null,
    make('button', {type: 'button', title: 'Fit (0)', click: fit}, 'Fit'), make('button', {type: 'button', title: 'One to one (1)', click: () => zoomTo(1)}, '1:1'));
}

function pane(title, ...canvases) {
  const stage = make('div', {class: 'stage'}, ...canvases);
  listenToStage(stage);
  view.stages.push(stage);
  return make('figure', {class: 'pane'}, make('figcaption', {}, title), stage);
}

/* The golden below, and the new one from the cut on. */
function sliderPane(golden, fresh) {
  const above = canvasOf(fresh), figure = pane('golden | new', canvasOf(golden), above);
  const cut = make('div', {class: 'cut', role: 'slider', 'aria-label': 'Where the new picture begins'});
  figure.lastChild.append(cut);
  cut.addEventListener('pointerdown', (event) => { cut.setPointerCapture(event.pointerId); event.stopPropagation(); });
  cut.addEventListener('pointermove', (event) => {
    const box = figure.lastChild.getBoundingClientRect();
    if (cut.hasPointerCapture(event.pointerId)) { state.cut = Math.max(0, Math.min(1, (event.clientX - box.left) / box.width)); place(); }
  });
  view.slider = {above, cut};
  return figure;
}

function panesOf(golden, fresh) {
  const one = golden ?? fresh;
  if (!one) return [];
  if (!golden || !fresh) return [pane(golden ? 'golden' : 'new', canvasOf(one))];
  if (state.mode === 'side') return [pane('golden', canvasOf(golden)), pane('new', canvasOf(fresh)), pane(`difference x ${state.gain}`, canvasOf(amplified(golden, fresh)))];
  if (state.mode === 'slide') return [sliderPane(golden, fresh)];
  if (state.mode === 'difference') return [pane(`difference x ${state.gain}`, canvasOf(amplified(golden, fresh)))];
  if (state.mode === 'heat') return [pane('heat map: pale differs most, equal pixels are dim', canvasOf(heated(golden, fresh)))];
  const figure = pane('', canvasOf(golden), canvasOf(fresh));
  view.blink = {caption: figure.firstChild, above: figure.lastChild.lastChild};
  return [figure];
}

function blink() {
  if (!view?.blink) return;
  view.blink.above.style.visibility = state.showsNew ? 'visible' : 'hidden';
  view.blink.caption.textContent = `${state.showsNew ? 'new' : 'golden'}: space stops and steps`;
}

async function showScene(scene) {
  const other = scene !== state.scene;
  state.scene = scene;
  delete $('detail').dataset.shows;
  if (scene && !layersOf(scene).includes(state.layer)) state.layer = 'colour';
  markCurrent();
  if (!scene) { view = null; $('detail').replaceChildren(); return; }
  location.replace(`#${encodeURIComponent(scene.name)}`);
  const paths = pathsOf(scene);
  const fresh = await decode(paths.new), golden = paths.golden === paths.new ? fresh : await decode(paths.golden);
  if (state.scene !== scene) return;
  const both = Boolean(golden && fresh);
  view = {golden, fresh, stages: []};
  const panes = make('div', {class: 'panes'}, ...panesOf(golden, fresh));
  panes.classList.toggle('three', panes.children.length > 1);
  const size = golden ?? fresh;
  $('detail').replaceChildren(
    make('div', {class: 'title'}, make('h2', {}, scene.name), make('span', {class: `status ${scene.status}`}, scene.status),
      make('span', {class: 'soft'}, [scene.scene, size ? `${size.width} x ${size.height}` : null, scene.seconds ? `${scene.seconds.toFixed(2)} s` : null, scene.taken ? 'taken: the new picture is the golden now' : null].filter(Boolean).join('   '))),
    ...(scene.message ? [make('h3', {}, 'What is wrong'), make('pre', {class: 'message'}, scene.message)] : []),
    ...(size ? [toolbar(scene, both), panes, make('p', {id: 'values'})] : []),
    ...changesList(scene), ...metricsTable(scene), ...commandLines(scene));
  clearInterval(blinking);
  const still = matchMedia('(prefers-reduced-motion: reduce)').matches;
  if (view.blink) blinking = setInterval(() => { if (!still && !state.paused) { state.showsNew = !state.showsNew; blink(); } }, 600);
  blink();
  if (other || state.fitted) fit(); else place();
  tell(null);
  $('detail').dataset.shows = [scene.name, state.mode, state.layer].join(' ');
}

function setMode(mode) {
  state.mode = mode;
  state.paused = false;
  showScene(state.scene);
}

function setLayer(name) {
  state.layer = name;
  showScene(state.scene);
}

/* ---- Zoom ---- */

const widest = () => Math.max(view.golden?.width ?? 0, view.fresh?.width ?? 0);
const highest = () => Math.max(view.golden?.height ?? 0, view.fresh?.height ?? 0);

function place() {
  if (!view) return;
  for (const stage of view.stages)
    for (const canvas of stage.querySelectorAll('canvas')) canvas.style.transform = `translate(${state.left}px, ${state.top}px) scale(${state.zoom})`;
  if (!view.slider) return;
  const at = state.cut * view.slider.cut.parentElement.clientWidth;
  view.slider.cut.style.left = `${at - 1}px`;
  view.slider.above.style.clipPath = `inset(0 0 0 ${Math.max(0, (at - state.left) / state.zoom)}px)`;
}

function fit() {
  if (!view?.stages.length) return;
  const {clientWidth: width, clientHeight: height} = view.stages[0];
  state.zoom = Math.min(width / widest(), height / highest(), 16);
  state.left = (width - state.zoom * widest()) / 2;
  state.top = (height - state.zoom * highest()) / 2;
  state.fitted = true;
  place();
}

/* With the point of the stage that stays where it is; without, its middle. */
function zoomTo(zoom, x, y) {
  if (!view?.stages.length) return;
  x ??= view.stages[0].clientWidth / 2;
  y ??= view.stages[0].clientHeight / 2;
  zoom = Math.max(0.05, Math.min(64, zoom));
  state.left = x - (x - state.left) * zoom / state.zoom;
  state.top = y - (y - state.top) * zoom / state.zoom;
  state.zoom = zoom;
  state.fitted = false;
  place();
}

function listenToStage(stage) {
  let from = null;
  const pixel = (event) => {
    const box = stage.getBoundingClientRect();
    return [Math.floor((event.clientX - box.left - stage.clientLeft - state.left) / state.zoom), Math.floor((event.clientY - box.top - stage.clientTop - state.top) / state.zoom)];
  };
  stage.addEventListener('wheel', (event) => {
    const box = stage.getBoundingClientRect();
    event.preventDefault();
    zoomTo(state.zoom * 1.2 ** -Math.sign(event.deltaY), event.clientX - box.left, event.clientY - box.top);
  }, {passive: false});
  stage.addEventListener('pointerdown', (event) => { from = [event.clientX - state.left, event.clientY - state.top]; stage.setPointerCapture(event.pointerId); });
  stage.addEventListener('pointerup', () => { from = null; });
  stage.addEventListener('pointermove', (event) => {
    if (from) {
      state.left = event.clientX - from[0];
      state.top = event.clientY - from[1];
      state.fitted = false;
      place();
    }
    tell(pixel(event));
  });
}

function valueAt(image, [x, y]) {
  if (!image || x < 0 || y < 0 || x >= image.width || y >= image.height) return null;
  const at = y * image.width + x;
  if (image.numbers) return Array.from(image.numbers.subarray(image.channels * at, image.channels * (at + 1)));
  return Array.from(image.data.subarray(4 * at, 4 * at + 3));
}

/* The numbers of both at a pixel, as their files have them. */
function tell(at) {
  const line = $('values');
  if (!line) return;
  if (!at) { line.textContent = 'Point at a pixel for its values; the wheel zooms, dragging moves.'; return; }
  const golden = valueAt(view.golden, at), fresh = valueAt(view.fresh, at);
  const row = (name, value) => value ? `\n${name.padEnd(7)} ${value.map((v) => String(v).padStart(6)).join('')}` : '';
  const apart = golden && fresh && view.golden !== view.fresh ? row('apart', golden.map((v, c) => fresh[c] - v)) : '';
  line.textContent = `x ${at[0]}  y ${at[1]}${row('golden', golden)}${view.golden === view.fresh ? '' : row('new', fresh)}${apart}`;
}

/* ---- Keys ---- */

function toggleTheme() {
  const dark = document.documentElement.dataset.theme === 'dark';
  document.documentElement.dataset.theme = dark ? 'light' : 'dark';
}

const KEYS = [
  ['j', 'next scene', () => step(1)], ['k', 'scene before', () => step(-1)],
  ['f', 'next filter', () => {
    const names = [...$('filters').children].map((button) => button.dataset.filter);
    setFilter(names[(names.indexOf(state.filter) + 1) % names.length]);
  }],
  ['/', 'find a scene', () => $('search').focus()],
  ...MODES.map(([mode, label, key]) => [key, label.toLowerCase(), () => setMode(mode)]),
  [' ', 'while it blinks: stop, and step', () => { if (view?.blink) { state.paused = true; state.showsNew = !state.showsNew; blink(); } }],
  ['p', 'next pass: colour, object, normal ...', () => {
    const names = state.scene ? layersOf(state.scene) : [];
    if (names.length) setLayer(names[(names.indexOf(state.layer) + 1) % names.length]);
  }],
  ['+', 'closer', () => zoomTo(state.zoom * 1.5)], ['-', 'farther', () => zoomTo(state.zoom / 1.5)],
  ['0', 'fit', fit], ['1', 'one to one', () => zoomTo(1)],
  ['c', 'copy the command', () => document.querySelector('.command button')?.click()],
  ['t', 'dark or light', toggleTheme], ['?', 'these keys', () => $('help').showModal()],
];
const ALIASES = {ArrowDown: 'j', ArrowUp: 'k', ArrowRight: 'j', ArrowLeft: 'k', '=': '+'};

document.addEventListener('keydown', (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey || $('help').open) return;
  if (event.target === $('search')) {
    if (event.key === 'Escape' || event.key === 'Enter') $('search').blur();
    return;
  }
  if (/^(SELECT|BUTTON)$/.test(event.target.tagName) && / |Arrow|Enter/.test(event.key)) return;
  const found = KEYS.find(([key]) => key === (ALIASES[event.key] ?? event.key));
  if (!found) return;
  event.preventDefault();
  found[2]();
});

/* ---- To begin with ---- */

document.documentElement.dataset.theme = matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light';
$('about').textContent = results.about ?? '';
$('search').addEventListener('input', () => { state.search = $('search').value.trim().toLowerCase(); drawList(); if (!shown().includes(state.scene)) showScene(shown()[0] ?? null); });
$('theme').addEventListener('click', toggleTheme);
$('keys').addEventListener('click', () => $('help').showModal());
$('helplist').replaceChildren(...KEYS.flatMap(([key, doc]) => [make('dt', {}, key === ' ' ? 'space' : key), make('dd', {}, doc)]));
addEventListener('resize', () => { if (state.fitted) fit(); else place(); });
drawFilters();
drawList();
showScene(scenes.find((scene) => location.hash === `#${encodeURIComponent(scene.name)}`) ?? scenes[0] ?? null);
