// With what a program would run that does not, or not well. The daemon has checked each of them.
import { say } from '../core/language';
import { fromMm, lengthUnit } from '../core/units';
import type { Program } from '../machine/api';
import { proposalsFor, type Proposal } from '../machine/studies';
import { Icon } from './icon';

const turns = (axis: string): boolean => 'ABC'.includes(axis.toUpperCase());
const shown = (axis: string, value: number): string => String(Number((turns(axis) ? value : fromMm(value)).toFixed(4)));

// "G54 X13 Y-40, G55 Z5"
function zerosText(zeros: Record<string, Record<string, number>>): string {
  return Object.entries(zeros)
    .map(([system, axes]) => [system, ...Object.entries(axes).map(([axis, value]) => `${axis}${shown(axis, value)}`)].join(' '))
    .join(', ');
}

export function wordsOf(one: Proposal): string {
  switch (one.kind) {
    case 'work-zero':
      return say('proposal.work-zero', { zeros: zerosText(one.zeros), unit: lengthUnit() });
    case 'axis-too-short':
      return say('proposal.axis-too-short', {
        axis: one.axis,
        needed: shown(one.axis, one.needed),
        travel: shown(one.axis, one.travel),
        unit: turns(one.axis) ? '°' : lengthUnit(),
      });
    case 'tools':
      return say('proposal.tools', { tools: one.tools.map((tool) => `T${tool}`).join(', ') });
    case 'spindle-speed':
      return one.feed_percent < 100
        ? say('proposal.spindle-speed.feed', { rpm: one.spindle_rpm, percent: one.feed_percent })
        : say('proposal.spindle-speed', { rpm: one.spindle_rpm });
    case 'override':
      return say('proposal.override', { feed: one.feed_percent, rapid: one.rapid_percent });
    default:
      return (one as { words: string }).words; // of a newer daemon
  }
}

export function ProposalList({ all }: { all: readonly Proposal[] }) {
  return (
    <ul class="findings" data-testid="proposals">
      {all.map((one) => (
        <li key={one.words}>
          <span class="finding">
            <Icon name="done" />
            <span>{wordsOf(one)}</span>
          </span>
        </li>
      ))}
    </ul>
  );
}

export function Proposals({ program }: { program: Program }) {
  const all = proposalsFor(program);
  if (all.length === 0) return null;
  return (
    <>
      <h2 class="findings-title">{say('proposals.title')}</h2>
      <ProposalList all={all} />
    </>
  );
}
