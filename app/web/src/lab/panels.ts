// All panels of the lab but the glass, and how they hang together.
import './lab_panels.css';
import { Gallery } from './gallery';
import { HandBar } from './hand_bar';
import { Knobs } from './knobs';
import { LedgerPanel } from './ledger_panel';
import { LivePlots } from './live_plots';
import { Notes } from './notes';
import type { LabPage, PanelSet } from './panel';
import { PostMortem } from './post_mortem';
import { TimeBar } from './time_bar';

export function panelsOf(page: LabPage): PanelSet {
  const knobs = new Knobs(page);
  const time = new TimeBar(page, () => knobs.changes);
  const notes = new Notes();
  time.add(notes);
  return {
    knobs,
    plots: new LivePlots(page),
    ledger: new LedgerPanel(),
    time,
    hand: new HandBar(page),
    gallery: new Gallery(page),
    dead: new PostMortem(page, time.rewind),
  };
}
