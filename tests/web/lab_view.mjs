// The lab's 3-D view without a browser: decoding of frames, dragged points. Run by test_lab_logic.py: node --test
// lab_view.mjs, MODULES in the environment.
import assert from 'node:assert/strict';
import { test } from 'node:test';
import { pathToFileURL } from 'node:url';

// As much of a document as the modules need; letters are 4 pixels wide, capitals 12.
class FakeNode {
  children = [];
  style = {};
  clientWidth = 900;
  append(...nodes) {
    this.children.push(...nodes);
  }
  getBoundingClientRect() {
    return { left: 0, top: 0 };
  }
  getContext() {
    const measureText = (text) => {
      measured.push(text);
      return { width: widthOf(text) };
    };
    return { getExtension: () => null, measureText };
  }
  addEventListener() {}
  setAttribute() {}
  replaceChildren() {}
  contains() {}
}
const measured = [];
const widthOf = (text) => [...text].reduce((sum, letter) => sum + (letter < 'a' ? 12 : 4), 0);
Object.assign(globalThis, {
  Node: FakeNode,
  location: { search: '' },
  document: { createElement: () => new FakeNode(), createElementNS: () => new FakeNode() },
  getComputedStyle: () => ({ font: '13px sans-serif' }),
});

const page = await import(pathToFileURL(process.env.MODULES).href);
const { decodeFrame, labelText, placeOf, decodeMesh, inWorld, inLink, THREE } = page;
const { PointDrag, JointDrag, planeOfMotion, Pace, Controller } = page;
const { Labels, LiveStage, Painter, Hints } = page;

// Independent copy of the protocol's table.
const ORDER = [
  ['channels', Float64Array], ['works', Float64Array], ['link', Float32Array], ['target', Float32Array],
  ['position', Float32Array], ['scale', Float32Array], ['turn', Int16Array],
  ['labelPosition', Float32Array], ['labelOffset', Int16Array], ['textEnd', Uint32Array],
  ['first', Uint32Array], ['firstLabel', Uint32Array], ['mesh', Uint16Array], ['body', Uint16Array],
  ['color', Uint8Array], ['flags', Uint8Array], ['shininess', Uint8Array], ['texture', Uint8Array],
  ['text', Uint8Array],
];
function bytesOf(frame) {
  const parts = ORDER.map(([name, Kind]) => Buffer.from(Kind.from(frame[name]).buffer));
  const size = parts.reduce((at, part) => Math.ceil(at / 8) * 8 + part.length, 80);
  const out = Buffer.alloc(size);
  out.writeUInt32LE(0x31465754, 0);
  out.writeUInt32LE(7, 4);
  out.writeDoubleLE(1.25, 8);
  out.writeDoubleLE(99.5, 16);
  out.writeDoubleLE(0.004, 24);
  out.writeBigUInt64LE(1250n, 32);
  out.writeUInt32LE(3, 40);
  out.writeUInt32LE(2 | 4, 44);
  const counts = [frame.channels.length, frame.works.length, frame.first.length - 1,
    frame.mesh.length, frame.textEnd.length, frame.text.length, frame.link.length / 7, 0];
  counts.forEach((count, i) => out.writeUInt32LE(count, 48 + 4 * i));
  let at = 80;
  for (const part of parts) {
    at = Math.ceil(at / 8) * 8;
    part.copy(out, at);
    at += part.length;
  }
  return out.buffer.slice(out.byteOffset, out.byteOffset + size);
}
const text = Buffer.from('armµ2');
const frame = {
  channels: [0.1, NaN, -3], works: [1e-9], link: [0, 0, 0, 0, 0, 0, 1, 1, 2, 3, 0, 0, 1, 0],
  target: [NaN, NaN, NaN, NaN, NaN, NaN, NaN, 4, 5, 6, 0, 0, 0, 1], position: [1, 2, 3], scale: [1, 1, 2],
  turn: [0, 0, 0, 32767], labelPosition: [1, 1, 1, 2, 2, 2], labelOffset: [10, -6, 0, 0],
  textEnd: [3, text.length], first: [0, 1, 1], firstLabel: [0, 0, 2], mesh: [5], body: [1],
  color: [1, 2, 3, 255], flags: [1], shininess: [80], texture: [0], text: [...text],
};

test('frame: all arrays are decoded, without a copy', () => {
  const buffer = bytesOf(frame);
  const read = decodeFrame(buffer);
  for (const [name, Kind] of ORDER) {
    assert.deepEqual(read[name], Kind.from(frame[name]), name);
    assert.equal(read[name].buffer, buffer, name);
  }
  assert.deepEqual([read.scene, read.time, read.stamp, read.number], [7, 1.25, 99.5, 3]);
  assert.deepEqual([read.paused, read.lookedBack], [false, true]);
  assert.deepEqual([labelText(read, 0), labelText(read, 1)], ['arm', 'µ2']);
  assert.deepEqual(placeOf(read.link, 1), [1, 2, 3]);
  assert.equal(placeOf(read.target, 0), null);
});

test('frame: truncated data gives null', () => {
  const whole = bytesOf(frame);
  for (let size = 0; size < whole.byteLength; ++size)
    assert.equal(decodeFrame(whole.slice(0, size)), null, `${size} bytes`);
  const other = whole.slice(0);
  new DataView(other).setUint32(0, 1, true);
  assert.equal(decodeFrame(other), null);
});

test('mesh: all arrays are decoded', () => {
  const out = Buffer.alloc(16 + 4 * (3 + 3 + 2 + 3));
  [1, 3, 3, 0].forEach((word, i) => out.writeUInt32LE(word, 4 * i));
  [1, 2, 3, 0, 0, 1, 0.25, 0.5].forEach((value, i) => out.writeFloatLE(value, 16 + 4 * i));
  const mesh = decodeMesh(out.buffer.slice(out.byteOffset, out.byteOffset + out.length));
  assert.deepEqual([...mesh.position], [1, 2, 3]);
  assert.deepEqual([...mesh.normal], [0, 0, 1]);
  assert.deepEqual([...mesh.uv], [0.25, 0.5]);
  assert.deepEqual([...mesh.index], [0, 0, 0]);
  assert.equal(mesh.twoSided, true);
});

const near = (a, b, limit, words) => assert.ok(Math.abs(a - b) < limit, `${words ?? ''} ${a} ${b}`);

test('link axes and world axes are inverse transforms', () => {
  const half = Math.SQRT1_2; // rotation by 90 degrees about z at (1, 2, 3)
  const places = Float32Array.from([0, 0, 0, 0, 0, 0, 1, 1, 2, 3, 0, 0, half, half]);
  const world = inWorld(places, 1, [0.5, 0, 0.25]);
  [1, 2.5, 3.25].forEach((value, i) => near(world.toArray()[i], value, 1e-6));
  inLink(places, 1, world).forEach((value, i) => near(value, [0.5, 0, 0.25][i], 1e-6));
});

function stageAt(eye) {
  const camera = new THREE.PerspectiveCamera(40, 1.5, 0.01, 100);
  camera.up.set(0, 0, 1);
  camera.position.set(...eye);
  camera.lookAt(0.1, 0.05, 0.2);
  camera.updateMatrixWorld();
  const host = { clientWidth: 900, clientHeight: 600 };
  const project = (x, y, z) => {
    const p = new THREE.Vector3(x, y, z).project(camera);
    return { x: (0.5 + 0.5 * p.x) * 900, y: (0.5 - 0.5 * p.y) * 600 };
  };
  return { host, camera, project };
}
const EYES = [[2, -1, 1], [0.3, 2, 0.2], [-1.5, -1.5, 2.5], [0.1, 0.05, 3]];
const START = [0.3, -0.1, 0.35];

test('point drag: constant offset from the pointer, in the plane of the view', () => {
  for (const eye of EYES) {
    const stage = stageAt(eye);
    const goal = new THREE.Vector3(...START);
    const begin = stage.project(...START);
    const drag = new PointDrag(stage, goal.clone(), { x: begin.x + 4, y: begin.y - 3 });
    drag.move({ x: begin.x + 84, y: begin.y - 53 }, false);
    const end = stage.project(...drag.goal.toArray());
    near(end.x, begin.x + 80, 0.7);
    near(end.y, begin.y - 50, 0.7);
    const sight = stage.camera.getWorldDirection(new THREE.Vector3());
    near(drag.goal.clone().sub(goal).dot(sight), 0, 1e-9);
  }
});

test('point drag: a point of a planar robot moves in its plane in every direction, from every camera', () => {
  const up = new THREE.Vector3(0, 0, 1);
  for (const eye of [...EYES, [2, -1, 0.2]])
    for (let i = 0; i < 8; ++i) {
      const stage = stageAt(eye);
      const begin = stage.project(...START);
      const [dx, dy] = [60 * Math.cos((i * Math.PI) / 4), 60 * Math.sin((i * Math.PI) / 4)];
      const drag = new PointDrag(stage, new THREE.Vector3(...START), begin, up);
      for (let k = 1; k <= 4; ++k) drag.move({ x: begin.x + (k * dx) / 4, y: begin.y + (k * dy) / 4 }, false);
      near(drag.goal.z, START[2], 1e-9);
      const moved = drag.goal.distanceTo(new THREE.Vector3(...START));
      assert.ok(moved > 0.05 && moved < 1, `${eye}, direction ${i}: ${moved} m`);
      const end = stage.project(...drag.goal.toArray());
      if (Math.abs(dx) > 1) assert.ok((end.x - begin.x) * dx > 0, `${eye}, direction ${i}: sideways`);
    }
});

test('plane of motion: perpendicular to parallel rotations; none with other rotations or slides', () => {
  const axis = (direction, slides = false) => ({ origin: new THREE.Vector3(), direction: new THREE.Vector3(...direction), slides });
  const turn = axis([0, 0, 1]);
  assert.deepEqual(planeOfMotion([turn, axis([0, 0, -1]), axis([1, 0, 0], true)]).toArray(), [0, 0, 1]);
  for (const other of [axis([0, 1, 0]), axis([0, 0, 1], true)]) assert.equal(planeOfMotion([turn, other]), null);
  assert.equal(planeOfMotion([axis([1, 0, 0], true)]), null);
});

test('point drag: shift changes the height only, without a jump after it', () => {
  for (const eye of EYES) {
    const stage = stageAt(eye);
    const begin = stage.project(...START);
    const drag = new PointDrag(stage, new THREE.Vector3(...START), begin);
    drag.move({ x: begin.x + 40, y: begin.y - 60 }, true);
    const [x, y, z] = drag.goal.toArray();
    assert.deepEqual([x, y], START.slice(0, 2));
    if (eye !== EYES[3]) assert.ok(z > START[2] + 0.01, `${z}`);
    drag.move({ x: begin.x + 40, y: begin.y - 60 }, false);
    [x, y, z].forEach((value, i) => near(drag.goal.toArray()[i], value, 1e-9));
  }
});

test('point drag: the wheel moves along the line of sight', () => {
  const stage = stageAt(EYES[0]);
  const begin = stage.project(...START);
  const drag = new PointDrag(stage, new THREE.Vector3(...START), begin);
  const far = stage.camera.position.distanceTo(drag.goal);
  drag.deepen(0.2);
  near(stage.camera.position.distanceTo(drag.goal), 1.2 * far, 1e-9);
  const end = stage.project(...drag.goal.toArray());
  near(end.x, begin.x, 1e-6);
  near(end.y, begin.y, 1e-6);
});

// Only from views in which the motion is visible.
test('joint drag: the grabbed point follows the pointer', () => {
  const axes = [
    { direction: [0, 0, 1], slides: false }, { direction: [0, 1, 0], slides: false },
    { direction: [0.6, 0, 0.8], slides: true },
  ];
  for (const eye of [EYES[0], [1.2, 1.6, 0.5], EYES[2]])
    for (const { direction, slides } of axes) {
      const stage = stageAt(eye);
      const along = new THREE.Vector3(...direction);
      const origin = new THREE.Vector3(0, 0, 0.1);
      const grabbed = new THREE.Vector3(...START);
      const drag = new JointDrag(stage, { origin, direction: along, slides }, grabbed, 0.2, {});
      let value = 0.2;
      const step = slides ? 0.01 : 0.04;
      for (let i = 0; i < 12; ++i) {
        value += step;
        const turned = grabbed.clone();
        if (slides) turned.addScaledVector(along, value - 0.2);
        else turned.sub(origin).applyAxisAngle(along, value - 0.2).add(origin);
        near(drag.move(stage.project(...turned.toArray())), value, 0.02 * Math.abs(value), `${eye}`);
      }
    }
});

test('joint drag: joint limits', () => {
  const stage = stageAt(EYES[0]);
  const axis = { origin: new THREE.Vector3(), direction: new THREE.Vector3(0, 0, 1), slides: false };
  const drag = new JointDrag(stage, axis, new THREE.Vector3(...START), 0, { low: -0.1, high: 0.1 });
  const { x, y } = stage.project(...START);
  assert.equal(Math.abs(drag.move({ x: x + 300, y })), 0.1);
  assert.equal(Math.abs(drag.move({ x: x - 300, y })), 0.1);
});

test('frame rate: slow drawing is detected, a pause is not', () => {
  const asked = (times) => {
    const pace = new Pace();
    return times.map((time) => pace.painted(time)).filter(Boolean).length;
  };
  const every = (pause, count, from = 0) => Array.from({ length: count }, (_, i) => from + i * pause);
  assert.equal(asked(every(16, 600)), 0);
  assert.equal(asked(every(100, 62)), 1);
  assert.equal(asked([...every(16, 40), ...every(16, 40, 60_000)]), 0);
});

test('game controller: axes in the order of the device files, right, up, toward, yaw, pitch, roll', () => {
  const pad = { connected: true, axes: [0, 0, 0, 0], buttons: Array.from({ length: 16 }, () => ({ value: 0 })) };
  Object.defineProperty(globalThis, 'navigator', { value: { getGamepads: () => [pad] }, configurable: true });
  globalThis.addEventListener = () => {};
  let rates = null;
  const operator = { useSource: () => true, move: (command) => (rates = command.rates), button: () => {} };
  const controller = new Controller(operator, () => {});
  const at = (axes, pressed = []) => {
    pad.axes = axes;
    pad.buttons.forEach((button, i) => (button.value = pressed.includes(i) ? 1 : 0));
    controller.poll();
    return rates.map((rate) => Math.round(10 * rate) / 10 + 0);
  };
  assert.deepEqual(at([1, 0, 0, 0]), [1, 0, 0, 0, 0, 0]);
  assert.deepEqual(at([0, -1, 0, 0]), [0, 1, 0, 0, 0, 0]); // stick up
  assert.deepEqual(at([0, 0, 0, 1]), [0, 0, 1, 0, 0, 0]); // stick towards the user
  assert.deepEqual(at([0, 0, 1, 0]), [0, 0, 0, 1, 0, 0]);
  assert.deepEqual(at([0, 0, 0, 0], [12, 15]), [0, 0, 0, 0, 1, -1]);
  assert.deepEqual(at([0, 0, 0, 0], [7, 15]), [0, 0, 0, 0, 0, -1]);
});

test('labels: the free place follows from the measured width, measured once per text', () => {
  const labels = new Labels();
  const columns = { first: [0, 2], text: [0, 1], position: new Float32Array(6), offset: Int16Array.of(10, 0, 10, 0) };
  measured.length = 0;
  for (const texts of [['a', 'iiii'], ['a', 'WWWW'], ['a', 'iiii']]) {
    labels.paint(() => ({ x: 400, y: 300 }), texts, [{ columns, frame: 0 }]);
    const [, first, second] = labels.root.children.map(({ style }) => style.transform);
    assert.equal(first, 'translate(410px, 291.5px)');
    assert.equal(second, `translate(${400 - 10 - widthOf(texts[1]) - 6}px, 291.5px)`); // left of the point
  }
  assert.deepEqual(measured, ['a', 'iiii', 'WWWW']);
});

test('another scene from a file of the same name: camera at its start, earlier meshes freed', async () => {
  const fetched = [];
  globalThis.fetch = async (address) => {
    fetched.push(address.at(-1));
    return new Response(new ArrayBuffer(16));
  };
  let looks = 0;
  const freed = new Set();
  const made = () => new Painter(new THREE.Scene(), 0.1, () => ({}));
  const stage = {
    painter: made(),
    refurnish: () => {
      stage.painter.remove();
      stage.painter = made();
    },
    setTheme: () => {},
    look: () => (looks += 1),
  };
  const live = new LiveStage(new FakeNode(), new FakeNode(), () => {});
  live.stage = stage;
  const show = async (scene, ...meshes) => {
    await live.show({ scene, file: 'robot.urdf', bodies: [{ name: 'arm' }], meshes, textures: [] });
    for (const geometry of stage.painter.geometries) geometry.addEventListener('dispose', () => freed.add(geometry));
    return [looks, freed.size, fetched.join('')];
  };
  assert.deepEqual(await show(1, 'a'), [1, 0, 'a']);
  assert.deepEqual(await show(2, 'b'), [2, 1, 'ab']);
  assert.deepEqual(await show(2, 'b', 'c'), [2, 1, 'abc']); // grown
  assert.deepEqual((await show(3, 'c', 'a'))[2], 'abca');
  assert.equal(looks, 3);
});

test('hints: closed ones stay closed while a scene grows, and come back with another scene of the same file', () => {
  const hints = new Hints();
  const show = (scene) => {
    hints.show({ scene, file: 'robot.urdf', look: ['the elbow'] });
    return hints.look.hidden;
  };
  assert.equal(show(1), false);
  hints.fold(true);
  assert.equal(show(1), true);
  assert.equal(show(2), false);
});
