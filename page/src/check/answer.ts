// The answer of the module: the keys of `passo check --json`, the machine, and the index of the path.
import type { Sentence } from '../core/faults';
import type { PathIndex } from '../machine/path_index';
import type { LoadedLine, Proposal, Verdict } from '../machine/studies';

export interface CheckFinding {
  severity: 'error' | 'warning';
  code: string;
  file: string;
  line: number;
  column: number;
  length: number;
  message: string;
  message_sentence: Sentence;
  expected: string;
  expected_sentence: Sentence;
  more_lines: number[];
  text: string;
}
export interface CheckedAxis {
  axis: string;
  rotary: boolean;
  travel: [number, number];
  motor: boolean;
}
export interface CheckedMachine {
  good: boolean;
  findings: CheckFinding[];
  name?: string;
  axes?: CheckedAxis[];
}
export interface SpeedBound {
  limit: 'feed' | 'velocity' | 'acceleration' | 'bending' | 'torque' | 'jerk' | 'none';
  axis: string | null;
}
export interface SpeedPart extends SpeedBound {
  line: number;
  rapid: boolean;
  unit: 'mm' | 'deg';
  time_s: number;
  lost_s: number;
  mean_mm_s: number;
  highest_mm_s: number;
  programmed_mm_s: number | null;
}
export interface CheckAnswer {
  machine: CheckedMachine;
  // Missing if the machine has errors.
  good?: boolean;
  errors?: number;
  findings?: CheckFinding[];
  waits?: number;
  waits_first_at?: { line: number; for: string; tool?: number; message?: string }[];
  // Missing if the program has errors.
  time_s?: number;
  dwell_s?: number;
  cutting_s?: number;
  rapid_s?: number;
  feed_mm?: number;
  rapid_mm?: number;
  tool_changes?: number;
  axes?: Record<string, { travel: [number, number]; extents: [number, number] | null; peak_speed: number; peak_acceleration: number }>;
  work?: Record<string, Record<string, [number, number]>>;
  speed?: { bounds: (SpeedBound & { time_s: number; first_line: number; value?: number })[]; slowest: SpeedPart[]; fastest: SpeedPart[] };
  margin?: { verdict: Verdict; worst_lines: LoadedLine[] } | null;
  proposals?: Proposal[];
  path?: Omit<PathIndex, 'program' | 'checks' | 'growing' | 'complete' | 'reach'>;
}
