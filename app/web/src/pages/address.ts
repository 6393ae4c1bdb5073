// What the page's address asks for: ?scene=six_integrators&set=integrator=euler&show=energy,couplings, as
// `twinarm lab SCENE --set --show` prints it. The commands are those of gallery, parameters and overlays. They are
// sent once: the query is removed from the address, so that reloading the page changes nothing.
import type { LabPage } from '../panels/panel';

const KEYS = ['scene', 'set', 'show'];

export class Address {
  readonly layers: string[] | null; // overlays; null: the remembered ones
  private name: string | null; // of a scene of the gallery
  private changes: string[]; // "coupling.stiffness=800"
  private before: number | null = null; // number of the scene that another one replaces

  constructor(query = new URLSearchParams(location.search)) {
    this.layers = query.get('show')?.split(',') ?? null;
    this.name = query.get('scene');
    this.changes = query.getAll('set');
    if (!KEYS.some((key) => query.has(key))) return;
    for (const key of KEYS) query.delete(key);
    history.replaceState(null, '', query.size > 0 ? `?${query}` : location.pathname);
  }

  // To be called with each state: sends the next command, when its scene is open.
  onState(page: LabPage): void {
    const { scene } = page;
    if (!scene || scene.scene === this.before || !(this.name ?? this.changes.length)) return;
    if (this.name !== null) {
      if (!page.send({ do: 'scene', name: this.name })) return this.giveUp();
      this.before = scene.scene;
      this.name = null;
    } else {
      const { changes } = this;
      this.giveUp();
      if (page.send({ do: 'set', changes })) page.send({ do: 'reset' }); // they hold from t = 0
    }
  }

  // Another client has control, as the page says.
  private giveUp(): void {
    this.name = null;
    this.changes = [];
  }
}
