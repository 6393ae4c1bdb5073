// 3-D view: lights, ground, camera and the current draw list.
import './stage.css';
import * as THREE from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import type { MeshData, View } from '../protocol/run';
import { Arrows } from './arrows';
import { Ground } from './ground';
import { Labels, type Pixel } from './labels';
import { glossy, plainly } from './surfaces';
import { Painter, type Part } from './painter';

export type { Pixel };
export type ViewName = 'start' | 'front' | 'side' | 'top' | 'iso';

// From target to eye. Top: x to the right, y up.
const DIRECTIONS: Record<Exclude<ViewName, 'start'>, [number, number, number]> = {
  front: [0, -1, 0.07],
  side: [1, 0, 0.07],
  top: [0, -0.001, 1],
  iso: [1, -1, 0.82],
};

// Background as in pictures of `twinarm render`: a smooth step from bottom to top, mixed in linear light.
function backdrop(view: View, dark: boolean): string {
  const light = dark ? 0.05 : 1;
  const encode = new THREE.Color();
  const color = (bytes: View['top']) =>
    new THREE.Color().setRGB(bytes[0] / 255, bytes[1] / 255, bytes[2] / 255, THREE.SRGBColorSpace);
  const [bottom, top] = [color(view.bottom), color(view.top)];
  const stops = Array.from({ length: 11 }, (_, i) => {
    encode.lerpColors(bottom, top, THREE.MathUtils.smoothstep(i / 10, 0.05, 1));
    return `${encode.multiplyScalar(light).getStyle()} ${10 * i}%`;
  });
  return `linear-gradient(to top, ${stops.join(', ')})`;
}

const FITTED = 1.35; // width over height of the view for which the eye is given

// Levels of detail: device pixel ratio, size of the shadow map.
const DETAILS = [{ pixels: 2, shadow: 2048 }, { pixels: 1, shadow: 1024 }, { pixels: 0.75, shadow: 512 }];

export class Stage {
  readonly camera = new THREE.PerspectiveCamera();
  readonly controls: OrbitControls;
  private readonly renderer: THREE.WebGLRenderer;
  readonly labels = new Labels();
  private readonly scene = new THREE.Scene();
  painter!: Painter;
  private ground!: Ground;
  arrows!: Arrows;
  private readonly sun = new THREE.DirectionalLight(0xffffff, 2.2);
  private readonly sky = new THREE.HemisphereLight(0xffffff, 0x8a8f98, 1.5);
  private detail = 0;
  private readonly isPlain: boolean;
  private hasShadows: boolean;
  private followed: THREE.Vector3 | null = null;
  private foot = 0; // [pixels]

  constructor(
    readonly host: HTMLElement,
    private view: View,
    data: { meshes: MeshData[]; textures: ImageBitmap[] },
    private readonly changed: () => void,
    // Context of a software renderer: drawn without gloss.
    plain: WebGL2RenderingContext | null = null,
    // Height at the foot of the view that cards cover at first [pixels]: the scene is shown above it.
    private readonly covered = () => 0,
  ) {
    const canvas = plain?.canvas as HTMLCanvasElement | undefined;
    this.isPlain = plain !== null;
    this.renderer = new THREE.WebGLRenderer({
      antialias: true, // of its own context
      alpha: true,
      ...(plain ? { canvas, context: plain } : {}),
    });
    if (plain) this.detail = DETAILS.length - 1;
    this.hasShadows = plain === null; // else from the first picture on
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = THREE.PCFShadowMap;
    const { domElement } = this.renderer;
    domElement.setAttribute('role', 'img');
    domElement.setAttribute('aria-label', '3-D view of the robot');
    host.prepend(domElement, this.labels.root);

    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, domElement);
    this.controls.addEventListener('change', changed);
    this.scene.add(this.sky, this.sun, this.sun.target);
    this.furnish(view);
    this.painter.add(data.meshes, data.textures);
    this.look('start');
    new ResizeObserver(() => this.resize()).observe(host);
  }

  // Another run, without its meshes; keeps the camera.
  refurnish(view: View): void {
    this.painter.remove();
    this.ground.remove();
    this.arrows.remove();
    this.furnish(view);
  }

  // Later on slow machines, which take time to compile the shadow shaders.
  addShadows(): void {
    if (this.hasShadows) return;
    this.hasShadows = this.sun.castShadow = true;
    this.ground.showShadow(true);
    this.changed();
  }

  // To the next coarser level of detail.
  coarsen(): void {
    if (this.detail === DETAILS.length - 1) return;
    this.detail += 1;
    const { shadow } = this.sun;
    shadow.mapSize.setScalar(DETAILS[this.detail].shadow);
    shadow.map?.dispose();
    shadow.map = null;
    this.resize();
  }

  private furnish(view: View): void {
    this.view = view;
    this.camera.fov = (view.fieldOfView * 180) / Math.PI;
    this.camera.near = 0.01 * view.radius;
    this.camera.far = 60 * view.radius;
    this.foot = this.covered();
    this.resize();
    this.controls.minDistance = 0.15 * view.radius;
    this.controls.maxDistance = 20 * view.radius;
    this.placeLights();
    this.ground = new Ground(this.scene, view);
    this.ground.showShadow(this.hasShadows);
    this.arrows = new Arrows(this.scene, 0.008 * view.radius);
    this.painter = new Painter(this.scene, 0.03 * view.radius, this.isPlain ? plainly : glossy);
  }

  draw(parts: Part[]): void {
    this.painter.paint(parts);
    this.renderer.render(this.scene, this.camera);
  }

  look(name: ViewName): void {
    const { eye, target } = this.view;
    this.controls.target.set(...target);
    const offset = new THREE.Vector3(...eye).sub(this.controls.target);
    if (name !== 'start') offset.copy(new THREE.Vector3(...DIRECTIONS[name]).setLength(offset.length()));
    const farther = Math.max(1, FITTED / this.camera.aspect); // in a narrow view
    this.camera.position.copy(this.controls.target).addScaledVector(offset, farther);
    this.followed = null;
    this.controls.update();
    this.changed();
  }

  // Moves along with a point; null: stays.
  follow(point: [number, number, number] | null): void {
    const before = this.followed ?? this.controls.target.clone();
    this.followed = point && new THREE.Vector3(...point);
    if (!this.followed) return;
    const shift = this.followed.clone().sub(before);
    this.camera.position.add(shift);
    this.controls.target.add(shift);
    this.controls.update();
  }

  // Rotates about the target by angles [rad] and scales the distance.
  orbit(around: number, up: number, closer: number): void {
    this.controls.rotateLeft(-around);
    this.controls.rotateUp(up);
    this.controls.dollyIn(closer);
  }

  // World to pixels from the upper left of the view; null: behind the camera.
  readonly project = (x: number, y: number, z: number): Pixel | null => {
    const p = new THREE.Vector3(x, y, z).project(this.camera);
    if (p.z > 1 || p.z < -1) return null;
    const { clientWidth, clientHeight } = this.host;
    return { x: (0.5 + 0.5 * p.x) * clientWidth, y: (0.5 - 0.5 * p.y) * clientHeight };
  };

  setTheme(dark: boolean): void {
    this.host.style.background = backdrop(this.view, dark);
    this.ground.setTheme(dark);
    this.sky.groundColor.set(dark ? 0x4a525e : 0xa3a7ad);
    this.sky.intensity = dark ? 1.35 : 1.6;
    this.changed();
  }

  private placeLights(): void {
    const target = new THREE.Vector3(...this.view.target);
    const reach = 1.9 * this.view.radius;
    this.sky.position.set(0, 0, 1);
    this.sun.position.set(...this.view.light).setLength(3 * reach).add(target);
    this.sun.target.position.copy(target);
    this.sun.castShadow = this.hasShadows;
    this.sun.shadow.mapSize.setScalar(DETAILS[this.detail].shadow);
    const box = this.sun.shadow.camera;
    box.left = box.bottom = -reach;
    box.right = box.top = reach;
    box.near = reach;
    box.far = 5 * reach;
    this.sun.shadow.normalBias = 0.004 * this.view.radius;
    this.sun.shadow.radius = 3;
    box.updateProjectionMatrix();
  }

  // Fits the host.
  resize(): void {
    const { clientWidth, clientHeight } = this.host;
    // While printing, the layout has another size.
    if (clientWidth === 0 || clientHeight === 0 || matchMedia('print').matches) return;
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, DETAILS[this.detail].pixels));
    this.renderer.setSize(clientWidth, clientHeight);
    const free = Math.max(clientHeight - this.foot, 0.5 * clientHeight);
    this.camera.setViewOffset(clientWidth, free, 0, 0, clientWidth, clientHeight);
    this.changed();
  }
}
