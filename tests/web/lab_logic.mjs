// Logic of the lab's page without a browser: sliders, data of plots, files. Run by test_lab_logic.py, which
// bundles the modules: node --test lab_logic.mjs, MODULES in the environment.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { pathToFileURL } from 'node:url';

const page = await import(pathToFileURL(process.env.MODULES).href);
const { placeOf, valueAt, stepped, niceStep, numberText, parseNumber } = page;
const { Store, bucketsOf, outline, samples, timesOf, csvText, fileName } = page;
const { RunRecord, decodeHistory, PlotSpecs } = page;
const { chosen, post, short, tickText, gapsOf, LiveRun } = page;

// Reproducible random numbers.
function random(seed) {
  let state = seed;
  return () => (state = (1103515245 * state + 12345) % 2 ** 31) / 2 ** 31;
}

const scales = [
  { form: 'log', low: 1, high: 1e6 },
  { form: 'log', low: 1e-5, high: 0.1 },
  { form: 'log', low: 0, high: 1000 },
  { form: 'linear', low: -20, high: 20 },
  { form: 'linear', low: 0, high: 1.5 },
];

test('slider: position and value are inverse to three digits', () => {
  for (const scale of scales)
    for (let i = 0; i <= 200; ++i) {
      const value = valueAt(scale, i / 200);
      assert.ok(value >= scale.low && value <= scale.high, `${value}`);
      assert.ok(Math.abs(placeOf(scale, value) - i / 200) < 0.004, `${i} ${value}`);
      const again = valueAt(scale, placeOf(scale, value));
      assert.ok(Math.abs(again - value) <= 0.001 * (scale.high - scale.low) + 1e-12, `${again}`);
    }
});

test('logarithmic slider: the middle is the geometric mean', () => {
  assert.equal(valueAt({ form: 'log', low: 1, high: 1e6 }, 0.5), 1000);
  assert.equal(placeOf({ form: 'log', low: 1, high: 1e6 }, 1000), 0.5);
});

test('logarithmic slider with lower end 0: the left end is 0', () => {
  const scale = { form: 'log', low: 0, high: 1000 };
  assert.equal(valueAt(scale, 0), 0);
  assert.equal(placeOf(scale, 0), 0);
  assert.ok(stepped(scale, 0, 1, false) > 0);
  let value = 1000;
  for (let i = 0; i < 400; ++i) value = stepped(scale, value, -1, false);
  assert.equal(value, 0);
});

test('arrow keys change a slider by a tenth or a factor of two, within its range', () => {
  for (const scale of scales) {
    let value = scale.low;
    for (let i = 0; i < 2000; ++i) {
      const next = stepped(scale, value, 1, false);
      assert.ok(next > value || next === scale.high, `${value} ${next}`);
      value = next;
    }
    assert.equal(value, scale.high);
  }
  assert.equal(stepped(scales[0], 800, 1, false), 880);
  assert.equal(stepped(scales[0], 800, 1, true), 1600);
  assert.equal(stepped(scales[3], -9.8, 1, false), -9.6);
});

test('niceStep: 1, 2 or 5 times a power of ten', () => {
  for (const [size, step] of [[0.04, 0.02], [1, 1], [4.9, 2], [5, 5], [73, 50], [0.001, 0.001]])
    assert.equal(niceStep(size), step);
});

test('parseNumber: unit, prefixes, invalid text', () => {
  const read = [
    ['800', 'N/m', 800], ['1.2e4', 'N/m', 12000], ['12k', 'N/m', 12000], ['12 kN/m', 'N/m', 12000],
    ['0.5 ms', 's', 0.0005], ['−3,5', 'm', -3.5], ['63 µs', 's', 63e-6], ['2 m', 'm', 2],
    ['2 mm', 'm', 0.002], ['.5', '1', 0.5], [' 7 ', '', 7],
  ];
  for (const [text, unit, value] of read) assert.equal(parseNumber(text, unit), value, text);
  for (const text of ['', 'x', '1 2', '12 kg', '1e', 'k', '--1', '1.2.3', 'NaN', 'Infinity'])
    assert.ok(Number.isNaN(parseNumber(text, 'N/m')), text);
});

test('numberText and parseNumber are inverse', () => {
  for (const value of [0, 1, -9.81, 0.001, 800, 1e6, 123456, 2.5e-7, 1e9])
    assert.equal(parseNumber(numberText(value), ''), value);
  assert.ok(numberText(1 / 3).length <= 9);
});

// Reference implementation of Store.
class Plain {
  rows = [];
  dropped = 0;
  constructor(most) {
    this.most = most;
  }
  add(time, values) {
    const last = this.rows.at(-1);
    if (last && time < last[0]) return;
    if (last && time === last[0]) this.rows.pop();
    this.rows.push([time, ...values]);
    if (this.rows.length > this.most) {
      this.rows.shift();
      this.dropped += 1;
    }
  }
}
function same(store, plain) {
  assert.equal(store.length, plain.rows.length);
  assert.deepEqual([...store.times], plain.rows.map((row) => row[0]));
  for (let c = 0; c < store.columns; ++c)
    assert.deepEqual([...store.column(c)], plain.rows.map((row) => row[c + 1]));
}

test('store: equals the reference implementation for random operations', () => {
  const next = random(3);
  const store = new Store(2, 50);
  const plain = new Plain(50);
  let time = 0;
  for (let i = 0; i < 1500; ++i) {
    const what = next();
    if (what < 0.02 && plain.rows.length > 0) {
      time = plain.rows[Math.floor(next() * plain.rows.length)][0];
      store.cut(time);
      plain.rows = plain.rows.filter((row) => row[0] <= time);
    } else {
      if (what < 0.9) time += next();
      const asked = what > 0.97 ? time - 1 : time; // sometimes earlier than the last row
      const values = [next(), next() < 0.1 ? NaN : next()];
      const put = store.add(asked);
      if (put) values.forEach((value, c) => put(c, value));
      plain.add(asked, values);
    }
    same(store, plain);
    const from = time - 5 * next();
    assert.equal(store.after(from), plain.rows.filter((row) => row[0] <= from).length);
  }
  assert.equal(store.dropped, plain.dropped);
});

test('store: a copy has the later rows and one more, and does not change', () => {
  const store = new Store(1, 10);
  for (let i = 0; i < 14; ++i) store.add(i)(0, 10 * i);
  const copy = store.copy(8.5);
  store.cut(5);
  assert.deepEqual([...copy.times], [8, 9, 10, 11, 12, 13]);
  assert.deepEqual([...copy.column(0)], [80, 90, 100, 110, 120, 130]);
});

test('decimation keeps minima, maxima and the order of time', () => {
  const next = random(5);
  const values = Float64Array.from({ length: 5000 }, () => next() ** 9);
  const times = Float64Array.from(values, (_, i) => 0.01 * i);
  for (const [begin, end, most] of [[0, 5000, 300], [17, 4321, 100], [3, 40, 500], [0, 1, 10]]) {
    const buckets = bucketsOf(begin, end, 0, most);
    assert.ok(buckets.edges.length - 1 <= most + 1);
    const points = outline(values, buckets);
    const at = timesOf(times, buckets, true);
    assert.equal(at.length, points.length);
    at.forEach((time, i) => assert.ok(i === 0 || time >= at[i - 1]));
    const part = values.subarray(begin, end);
    assert.equal(Math.max(...points), Math.max(...part));
    assert.equal(Math.min(...points), Math.min(...part));
    assert.equal(timesOf(times, buckets, false).length, samples(values, buckets).length);
  }
});

test('decimation: points do not change when rows are added and dropped', () => {
  const store = new Store(1, 400);
  const next = random(7);
  const seen = new Map(); // begin of a bucket -> its points
  for (let i = 0; i < 2000; ++i) {
    store.add(i)(0, next());
    if (i < 500) continue;
    const buckets = bucketsOf(0, store.length, store.dropped, 60);
    const points = outline(store.column(0), buckets);
    const at = timesOf(store.times, buckets, true);
    for (let b = 1; b + 2 < buckets.edges.length; ++b) {
      assert.equal(at[2 * b] % buckets.stride, 0); // rows are numbered by their times
      const text = `${points[2 * b]} ${points[2 * b + 1]}`;
      assert.equal(seen.get(at[2 * b]) ?? text, text);
      seen.set(at[2 * b], text);
    }
  }
});

test('decimation: NaN makes a gap', () => {
  const values = Float64Array.from([1, NaN, NaN, NaN, NaN, 2, 3, NaN]);
  assert.deepEqual(outline(values, bucketsOf(0, 8, 0, 4)), [1, 1, null, null, 2, 2, 3, 3]);
  assert.deepEqual(outline(values, bucketsOf(0, 3, 0, 4)), [1, null, null]);
});

test('CSV: numbers are read back bit by bit', () => {
  const next = random(11);
  const rows = Array.from({ length: 40 }, () => [next() * 1e-7, -next() * 1e12, next() < 0.3 ? NaN : next()]);
  const names = ['time', 'contact/"a",b', 'line\nend'];
  const columns = names.map((name, c) => ({ name, unit: c === 0 ? 's' : '', value: (row) => rows[row][c] }));
  const text = csvText(columns, rows.length);
  // Parser of RFC 4180.
  const read = [[]];
  let field = '';
  let quoted = false;
  for (let i = 0; i < text.length; ++i) {
    const letter = text[i];
    if (quoted) {
      if (letter !== '"') field += letter;
      else if (text[i + 1] === '"') field += text[++i];
      else quoted = false;
    } else if (letter === '"') quoted = true;
    else if (letter === ',' || letter === '\n') {
      read.at(-1).push(field);
      field = '';
      if (letter === '\n') read.push([]);
    } else if (letter !== '\r') field += letter;
  }
  read.pop();
  assert.deepEqual(read[0], ['time [s]', 'contact/"a",b', 'line\nend']);
  read.slice(1).forEach((line, r) =>
    line.forEach((word, c) =>
      assert.ok(word === '' ? Number.isNaN(rows[r][c]) : Object.is(Number(word), rows[r][c])),
    ),
  );
  assert.equal(fileName('Hand & obstacles', 'all', 'csv'), 'hand-obstacles-all.csv');
});

const scene = (extra = []) => ({
  scene: 7,
  channels: [
    { name: 'q/a', unit: 'rad', kind: 'coordinate', of: 'a' },
    { name: 'target/a', unit: 'rad', kind: 'target', of: 'a' },
    { name: 'error/a', unit: 'rad', kind: 'error', of: 'a' },
    { name: 'error/b', unit: 'rad', kind: 'error', of: 'b' },
    ...extra,
  ],
  energy_balance: ['gravity', 'numerical'],
});
const frame = (time, a, b, number = 1, extra = []) => ({
  scene: 7,
  time,
  number,
  lookedBack: false,
  channels: Float64Array.from([a, 0, a, b, ...extra]),
  works: Float64Array.from([3 * time, -time]),
});

test('record: maximum and mean error over all frames, at uneven times', () => {
  const next = random(13);
  const record = new RunRecord(scene(), 30); // fewer than the frames
  const [{ max, mean }] = record.errors;
  let time = 0;
  let largest = 0;
  let area = 0;
  for (let i = 0; i < 100; ++i) {
    const passed = i === 0 ? 0 : 0.01 + next();
    time += passed;
    const [a, b] = [next() - 0.5, next() < 0.2 ? NaN : next() - 0.5];
    const now = Math.max(Math.abs(a), Math.abs(b) || 0);
    largest = Math.max(largest, now);
    area += now * passed;
    record.addFrame(frame(time, a, b));
    const row = record.store.length - 1;
    assert.equal(record.store.value(max, row), largest);
    if (i > 0) assert.ok(Math.abs(record.store.value(mean, row) - area / time) < 1e-12);
    assert.ok(Math.abs(record.store.value(record.sum, row) - 2 * time) < 1e-9);
  }
});

test('record: a new branch keeps the previous one, in either order of messages', () => {
  for (const stateFirst of [true, false]) {
    const record = new RunRecord(scene());
    for (let i = 0; i <= 100; ++i) record.addFrame(frame(i, i, 0));
    const state = { branch: { from: 60, changes: [], number: 1 } };
    if (stateFirst) record.onState(state);
    record.addFrame(frame(60, 60, 0));
    record.addFrame(frame(61, -61, 0));
    if (!stateFirst) record.onState(state);
    assert.equal(record.store.last, 61);
    assert.equal(record.store.value(0, 61), -61);
    assert.equal(record.before.first, 60);
    assert.equal(record.before.last, 100);
    assert.equal(record.before.value(0, 1), 61);
    record.onState({ branch: null });
    assert.equal(record.before, null);
  }
});

test('record: after a restart the largest values are those of the new run', () => {
  const record = new RunRecord(scene());
  for (let i = 0; i <= 10; ++i) record.addFrame(frame(i, i < 10 ? i : 1e12, 0));
  assert.equal(record.high[0], 1e12);
  record.addFrame(frame(4.5, 7, 0));
  assert.deepEqual([record.low[0], record.high[0]], [0, 7]);
});

test('record: earlier instants and other scenes are ignored', () => {
  const record = new RunRecord(scene());
  for (let i = 0; i <= 10; ++i) record.addFrame(frame(i, i, 0));
  record.addFrame({ ...frame(4, 99, 0), lookedBack: true });
  record.addFrame({ ...frame(40, 99, 0), scene: 8 });
  record.addFrame(frame(10, 11, 0)); // changed while paused
  assert.equal(record.store.length, 11);
  assert.equal(record.store.value(0, 10), 11);
});

function history(frames, width) {
  const numbers = [
    ...frames.map((one) => one.time),
    ...frames.flatMap((one) => [...one.channels].slice(0, width)),
    ...frames.flatMap((one) => [...one.works]),
  ];
  const buffer = new ArrayBuffer(24 + 8 * numbers.length);
  new Uint32Array(buffer, 0, 6).set([0x31485754, 7, frames.length, width, 2, 0]);
  new Float64Array(buffer, 24).set(numbers);
  return buffer;
}

test('record: missed frames are filled in, later ones stay', () => {
  const all = Array.from({ length: 50 }, (_, i) => frame(i, Math.sin(i), 0, i));
  const whole = new RunRecord(scene());
  for (const one of all) whole.addFrame(one);
  const record = new RunRecord(scene());
  for (const one of [...all.slice(5, 10), ...all.slice(30)]) record.addFrame(one);
  assert.equal(record.lost, 9);
  record.addHistory(decodeHistory(history(all.slice(0, 40), 4)));
  assert.deepEqual([...record.store.times], [...whole.store.times]);
  for (let c = 0; c < whole.store.columns; ++c)
    record.store.column(c).forEach((value, row) =>
      assert.ok(Math.abs(value - whole.store.value(c, row)) < 1e-12, `${c} ${row}`),
    );
  const cut = history(all, 4);
  assert.equal(decodeHistory(cut.slice(0, cut.byteLength - 8)), null);
  assert.equal(decodeHistory(new ArrayBuffer(8)), null);
});

test('record: many missed frames in a row are a gap until they are filled in', () => {
  const all = Array.from({ length: 200 }, (_, i) => frame(i, i, 0, i));
  const record = new RunRecord(scene());
  for (const i of [0, 1, 10, 20]) record.addFrame(all[i]); // a slow browser
  assert.deepEqual(record.gaps, []);
  for (const i of [100, 101, 180]) record.addFrame(all[i]);
  assert.deepEqual(record.gaps, [[20, 100], [101, 180]]);
  const chart = { valToPos: (time) => 10 * time };
  const drawn = gapsOf(record)(chart, 1, 0, 6, [[900, 1100], [1900, 1950]]);
  assert.deepEqual(drawn, [[200, 1000], [900, 1100], [1010, 1800], [1900, 1950]]);
  record.addHistory(decodeHistory(history(all.slice(50, 120), 4))); // the buffer begins at 50 s
  assert.deepEqual(record.gaps, [[20, 50], [119, 180]]);
  assert.deepEqual(record.grownTo(scene()).gaps, record.gaps);
  record.addFrame(frame(30, 0, 0, 201)); // a branch
  assert.deepEqual(record.gaps, [[20, 30]]);
  assert.equal(record.lost, 1); // not filled in yet
});

test('record: missed frames are requested again while no frame arrives', async ({ mock }) => {
  let now = 0;
  mock.method(performance, 'now', () => now);
  mock.timers.enable({ apis: ['setTimeout'] });
  globalThis.window = globalThis;
  globalThis.document = { addEventListener: () => {} };
  const all = Array.from({ length: 200 }, (_, i) => frame(i, i, 0, i));
  const answers = [() => new Response(history(all.slice(0, 2), 4)), () => new Response('', { status: 503 }),
    () => Promise.reject(new Error('not connected')), () => new Response(history(all, 4))];
  globalThis.fetch = async () => answers.shift()();
  const passed = async (time) => {
    now += time;
    mock.timers.tick(time);
    for (let i = 0; i < 20; ++i) await new Promise(setImmediate);
  };
  const run = new LiveRun({ state: null });
  run.onScene(scene());
  for (const i of [0, 1]) run.onFrame(all[i]);
  await passed(10);
  for (const i of [100, 199]) run.onFrame(all[i]); // then the run is paused
  for (let i = 0; i < 3; ++i) await passed(3000);
  assert.equal(answers.length, 0);
  assert.equal(run.record.store.length, 200);
  assert.deepEqual(run.record.gaps, []);
});

test('record: a new contact pair adds a column', () => {
  const record = new RunRecord(scene());
  for (let i = 0; i <= 20; ++i) record.addFrame(frame(i, i, 0, i));
  record.onState({ branch: { from: 15, changes: [], number: 1 } });
  record.addFrame(frame(16, -16, 0, 21));
  const pair = { name: 'contact/x-y', unit: 'N', kind: 'contact', of: 'x-y' };
  const grown = record.grownTo(scene([pair]));
  grown.addFrame(frame(17, 17, 0, 22, [5]));
  assert.equal(grown.store.length, 18);
  assert.equal(grown.store.value(0, 16), -16);
  assert.ok(Number.isNaN(grown.store.value(4, 16)));
  assert.equal(grown.store.value(4, 17), 5);
  assert.equal(grown.store.value(grown.sum, 17), 34);
  assert.equal(grown.before.last, 20);
  assert.equal(grown.lost, null);
});

test('plots: nonzero quantities, with stable colours', () => {
  const pairs = ['x', 'y', 'z'].map((of) => ({ name: `contact/${of}`, unit: 'N', kind: 'contact', of }));
  const record = new RunRecord(scene(pairs));
  const specs = new PlotSpecs(record);
  const named = (id) => specs.all(1e-3).find((spec) => spec.id === id);
  record.addFrame(frame(0, 0.1, 0, 1, [0, 0, 0]));
  assert.equal(named('contacts'), undefined);
  record.addFrame(frame(1, 0.2, 0, 2, [0, 4, 0]));
  assert.deepEqual(named('contacts').curves.map((curve) => curve.name), ['y']);
  const color = named('contacts').curves[0].color;
  record.addFrame(frame(2, 0.3, 0, 3, [9, 4, 1]));
  const later = named('contacts').curves;
  assert.deepEqual(later.map((curve) => curve.name), ['x', 'y', 'z']);
  assert.equal(later[1].color, color);
  assert.equal(new Set(later.map((curve) => curve.color)).size, 3);
  assert.deepEqual(named('angles').curves.map((curve) => curve.style), ['line', 'dashed']);
});

test('plots: one per quantity of the variants, one curve per variant', () => {
  const values = ['rk4', 'a/b'];
  const quantities = [['q/hinge', 'rad'], ['total_energy', 'J'], ['numerical', 'J']];
  const lanes = values.flatMap((of) =>
    quantities.map(([what, unit]) => ({ name: `variant/${what}/${of}`, unit, kind: 'variant', of })),
  );
  const own = { name: 'q/hinge', unit: 'rad', kind: 'coordinate', of: 'hinge' };
  const record = new RunRecord({ scene: 7, channels: [own, ...lanes], energy_balance: [] });
  for (const time of [0, 1]) {
    const channels = Float64Array.from({ length: 7 }, (_, i) => time * (i + 1));
    record.addFrame({ scene: 7, time, number: time, lookedBack: false, channels, works: new Float64Array() });
  }
  const all = new PlotSpecs(record).all(1e-3);
  assert.deepEqual(all.slice(0, 3).map(({ unit }) => unit), ['rad', 'J', 'J']);
  assert.equal(all[0].title, 'Angle: hinge');
  for (const spec of all.slice(0, 3)) {
    assert.deepEqual(spec.curves.map(({ name }) => name), values);
    assert.deepEqual(spec.curves.map(({ color }) => color), [0, 1]);
  }
  assert.deepEqual(all[1].curves.map(({ column }) => column), [2, 5]);
  assert.equal(all.find(({ id }) => id === 'angles'), undefined); // shown per variant
});

test('input source follows from the spec, not from the description', () => {
  const source = (source, spec, felt) => chosen({ source, spec, felt, mapping: '', q: [] });
  assert.equal(source('drag', '', 'a trace of a synthetic motion'), 'drag');
  assert.equal(source('device', 'virtual:synthetic:7', 'other words'), 'synthetic');
  assert.equal(source('device', 'virtual:trace:a.csv', 'other words'), 'trace');
  assert.equal(source('device', 'vrpn:Phantom0@localhost', 'synthetic'), 'device');
  assert.equal(source('device', 'gamepad', ''), 'device');
});

test('upload: the HTTP status determines the result, not the text', async () => {
  const answered = (status) => {
    globalThis.fetch = async () => new Response('words', { status });
    return post(new File([], 'a.toml')).then(({ state }) => state);
  };
  assert.equal(await answered(200), 'opened');
  assert.equal(await answered(202), 'kept');
  assert.equal(await answered(422), 'failed');
});

test('numbers have four digits, all before the point, and no noise', () => {
  const shown = [[12345, '12345'], [-999999, '−999999'], [1234567, '1.23e+6'], [1234.5678, '1235'], [9.80665, '9.807'],
    [4.2e-4, '4.20e−4'], [0, '0'], [NaN, '–'], [null, '–']];
  for (const [value, text] of shown) assert.equal(short(value), text);
  assert.equal(short(-2.19e-39, 1), '0');
  assert.equal(short(2e-9, 1), '2.00e−9');
  assert.equal(short(4e-9, 10), '0');
});

test('ticks of an axis differ from each other', () => {
  const axis = (from, interval, count) => Array.from({ length: count }, (_, i) => tickText(from + i * interval, interval));
  assert.deepEqual(axis(0.9995, 0.0005, 3), ['0.9995', '1.0000', '1.0005']);
  assert.deepEqual(axis(-90, 45, 5), ['−90', '−45', '0', '45', '90']);
  assert.deepEqual(axis(0, 2.5, 3), ['0', '2.5', '5.0']);
  assert.deepEqual(axis(0, 0.25, 3), ['0', '0.25', '0.50']);
  assert.deepEqual(axis(-2e-14, 1e-14, 3), ['−2e−14', '−1e−14', '0']);
  assert.deepEqual(axis(150000, 50000, 3), ['1.5e+5', '2.0e+5', '2.5e+5']);
  for (const interval of [1e-9, 2e-4, 0.1, 0.2, 0.5, 1, 2.5, 20, 250, 1e6, 5e7])
    for (const from of [-3 * interval, 1000 * interval, 0.7]) {
      const first = Math.ceil(from / interval) * interval;
      assert.equal(new Set(axis(first, interval, 6)).size, 6, `${first} ${interval} ${axis(first, interval, 6)}`);
    }
});

// The page of an address; `tell` shows it a state in the scene of this number.
function opened(query, accepts = () => true) {
  const sent = [];
  globalThis.location = { search: query, pathname: '/' };
  globalThis.history = { replaceState: (_state, _title, to) => (globalThis.location.left = to) };
  const address = new page.Address();
  const tell = (scene) =>
    address.onState({ scene: { scene }, send: (command) => accepts(command) && sent.push(command) > 0 });
  return { address, sent, tell, left: globalThis.location.left };
}

test('address: parameters and overlays are sent once, and removed from the address', () => {
  const { address, sent, tell, left } = opened('?token=ab&set=integrator%3Drk4&set=step%3D0.2&show=couplings%2Ccontacts');
  assert.deepEqual(address.layers, ['couplings', 'contacts']);
  assert.equal(left, '?token=ab');
  tell(3);
  tell(3);
  assert.deepEqual(sent, [{ do: 'set', changes: ['integrator=rk4', 'step=0.2'] }, { do: 'reset' }]);
});

test('address: parameters wait for the scene that it opens', () => {
  const { address, sent, tell, left } = opened('?scene=cradle&set=contact=compliant');
  assert.equal(address.layers, null);
  assert.equal(left, '/');
  tell(1);
  tell(1);
  assert.deepEqual(sent, [{ do: 'scene', name: 'cradle' }]);
  tell(2);
  tell(2);
  assert.deepEqual(sent.slice(1), [{ do: 'set', changes: ['contact=compliant'] }, { do: 'reset' }]);
});

test('address: nothing is sent without a query, or later when another client has control', () => {
  const plain = opened('?token=ab');
  plain.tell(1);
  assert.deepEqual([plain.sent, plain.left], [[], undefined]);
  let hasControl = false;
  const other = opened('?scene=cradle&set=a=1', () => hasControl);
  other.tell(1);
  hasControl = true;
  other.tell(1);
  other.tell(2);
  assert.deepEqual(other.sent, []);
});
