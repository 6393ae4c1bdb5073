// Ground: a metric grid that fades with distance, and the shadows on it. The plane itself is transparent, so
// that there is no horizon, as in pictures of `twinarm render`.
import * as THREE from 'three';
import type { View } from '../protocol/run';

const VERTEX = `
varying vec2 place;
void main() {
  vec4 world = modelMatrix * vec4(position, 1.0);
  place = world.xy;
  gl_Position = projectionMatrix * viewMatrix * world;
}`;

// A line is one pixel wide, by screen-space derivatives; it fades where cells become smaller than a pixel.
const FRAGMENT = `
uniform float cell;
uniform float major;
uniform float reach;
uniform vec2 middle;
uniform vec3 ink;
varying vec2 place;
float lines(float size, float width) {
  vec2 at = place / size;
  vec2 step = fwidth(at);
  vec2 off = abs(fract(at - 0.5) - 0.5) / step;
  float fine = 1.0 - smoothstep(0.25, 0.7, max(step.x, step.y));
  return fine * (1.0 - smoothstep(width - 0.5, width + 0.5, min(off.x, off.y)));
}
void main() {
  float away = length(place - middle) / reach;
  float fade = 1.0 - smoothstep(0.25, 1.0, away);
  float line = max(0.22 * lines(cell, 0.55), 0.42 * lines(cell * major, 0.7));
  gl_FragColor = vec4(ink, line * fade);
  #include <colorspace_fragment>
}`;

export class Ground {
  private readonly grid: THREE.Mesh<THREE.PlaneGeometry, THREE.ShaderMaterial>;
  private readonly shadow: THREE.Mesh<THREE.PlaneGeometry, THREE.ShadowMaterial>;

  constructor(private readonly scene: THREE.Scene, view: View) {
    const reach = 9 * view.radius;
    const plane = new THREE.PlaneGeometry(2 * reach, 2 * reach);
    const material = new THREE.ShaderMaterial({
      vertexShader: VERTEX,
      fragmentShader: FRAGMENT,
      transparent: true,
      depthWrite: false,
      uniforms: {
        cell: { value: view.ground.cell },
        major: { value: view.ground.cellsPerMajor },
        reach: { value: reach },
        middle: { value: new THREE.Vector2(view.target[0], view.target[1]) },
        ink: { value: new THREE.Color() },
      },
    });
    this.grid = new THREE.Mesh(plane, material);
    this.shadow = new THREE.Mesh(plane, new THREE.ShadowMaterial({ opacity: 0.3 }));
    this.shadow.material.depthWrite = false;
    this.grid.renderOrder = 1;
    this.shadow.renderOrder = 2;
    this.shadow.receiveShadow = true;
    for (const mesh of [this.grid, this.shadow]) {
      mesh.position.set(view.target[0], view.target[1], view.ground.height - 1e-4 * view.radius);
      mesh.visible = view.ground.visible;
      scene.add(mesh);
    }
  }

  remove(): void {
    for (const mesh of [this.grid, this.shadow]) {
      this.scene.remove(mesh);
      mesh.geometry.dispose();
      mesh.material.dispose();
    }
  }

  showShadow(on: boolean): void {
    this.shadow.visible = on && this.grid.visible;
  }

  setTheme(dark: boolean): void {
    const { ink } = this.grid.material.uniforms;
    (ink.value as THREE.Color).set(dark ? 0xb6c4d4 : 0x303842);
    this.shadow.material.opacity = dark ? 0.5 : 0.26;
  }
}
