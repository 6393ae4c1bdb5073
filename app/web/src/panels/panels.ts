// All panels of the lab but the glass, and how they hang together.
import { Gallery } from './gallery';
import { InputBar } from './input_bar';
import { Parameters } from './parameters';
import { EnergyPanel } from './energy';
import { Plots } from '../plot/plots';
import type { RunSource } from '../source/run_source';
import { Notes } from './notes';
import type { LabPage, PanelSet } from './panel';
import { Diverged } from './diverged';
import { LabTimeBar } from './lab_time_bar';

export function panelsOf(page: LabPage, run: RunSource): PanelSet {
  const knobs = new Parameters(page);
  const time = new LabTimeBar(page, () => knobs.changes);
  const notes = new Notes();
  time.add(notes);
  return {
    knobs,
    plots: new Plots(run),
    ledger: new EnergyPanel(run),
    time,
    hand: new InputBar(page),
    gallery: new Gallery(page),
    dead: new Diverged(page, time.rewind),
  };
}
