// The lab's panels except the inspector: `time` is the bar below the view, `input` in a corner of the view,
// `gallery` a dialog, `diverged` over the view while the run has diverged.
import { EnergyPanel } from '../panels/balances';
import { BuildMenu } from '../panels/build_menu';
import { Diverged } from '../panels/diverged';
import { Gallery } from '../panels/gallery';
import { InputBar } from '../panels/input_bar';
import { LabTimeBar } from '../panels/lab_time_bar';
import { Notes } from '../panels/menus';
import type { LabPage } from '../panels/panel';
import { Parameters } from '../panels/parameters';
import { Plots } from '../plot/plots';
import type { RunSource } from '../source/run_source';

export function panelsOf(page: LabPage, run: RunSource) {
  const parameters = new Parameters(page);
  const build = new BuildMenu(page);
  const notes = new Notes();
  const time = new LabTimeBar(page, () => parameters.changes, [build.root, notes.root]);
  return {
    build,
    notes,
    parameters,
    plots: new Plots(run),
    energy: new EnergyPanel(run),
    time,
    input: new InputBar(page),
    gallery: new Gallery(page),
    diverged: new Diverged(page, time.rewind),
  };
}
