// A motor while it is played: four coils with their currents, the field that they make, and the rotor that follows it.
import type { JSX } from 'preact';
import { memo } from 'preact/compat';
import type { Windings } from '../core';
import { say } from '../words';

interface MotorViewProps {
  axis: string;
  windings: Windings;
  place: number;
  fullSteps: number; // a turn
}

const angleOf = [0, -90, 180, 90]; // of F1 … F4 on the screen: counterclockwise

export function MotorView({ axis, windings, place, fullSteps }: MotorViewProps): JSX.Element {
  const entry = place - windings.first;
  const a = windings.phase_a[entry] ?? 0;
  const b = windings.phase_b[entry] ?? 0;
  const degrees = windings.degrees[entry] ?? 0;
  const pattern = windings.pattern[entry] ?? 0;
  const currents = [a, b, -a, -b].map((current) => Math.max(0, current));
  const outputs = [0, 1, 2, 3].map((output) => (pattern >> output) & 1).join('');
  const turned = degrees % 360;
  const radians = ((degrees + 45) * Math.PI) / 180;
  return (
    <figure class="lab-motor">
      <svg viewBox="-110 -110 220 220" role="img" aria-label={`${axis}: ${say('place')} ${place}, F1…F4 ${outputs}, ${turned.toFixed(1)}°`}>
        <circle class="lab-housing" r="104" />
        {currents.map((current, output) => (
          <g key={output} transform={`rotate(${angleOf[output]})`}>
            <rect class="lab-core" x="60" y="-19" width="36" height="38" rx="5" />
            <rect class="lab-coil" x="64" y="-25" width="27" height="50" rx="6" style={{ opacity: current }} />
            <path class="lab-turns" d="M70 -25V25M77.5 -25V25M85 -25V25" />
            <text transform={`translate(78 0) rotate(${-(angleOf[output] ?? 0)})`} class={current > 0.5 ? 'on' : ''}>
              F{output + 1}
            </text>
          </g>
        ))}
        <Rotor fullSteps={fullSteps} degrees={degrees} />
        <path
          class="lab-field-arrow"
          d={`M0 0L${(44 * a).toFixed(2)} ${(-44 * b).toFixed(2)}`}
          marker-end="url(#lab-arrow)"
        />
        {fullSteps === 4 && (
          <g class="lab-poles">
            <text x={(26 * Math.cos(radians)).toFixed(1)} y={(-26 * Math.sin(radians)).toFixed(1)}>N</text>
            <text x={(-26 * Math.cos(radians)).toFixed(1)} y={(26 * Math.sin(radians)).toFixed(1)}>S</text>
          </g>
        )}
        <defs>
          <marker id="lab-arrow" viewBox="0 0 10 10" refX="6" refY="5" markerWidth="4.5" markerHeight="4.5" orient="auto-start-reverse">
            <path class="lab-arrow-head" d="M0 0L10 5L0 10z" />
          </marker>
        </defs>
      </svg>
      <figcaption>
        <strong>{axis}</strong> {place} · <code>{outputs}</code> · {turned.toFixed(fullSteps > 24 ? 2 : 1)}°
      </figcaption>
    </figure>
  );
}

// A magnet with one pair of poles turns with the field. A toothed rotor turns by one tooth for four full steps.
const Rotor = memo(function Rotor({ fullSteps, degrees }: { fullSteps: number; degrees: number }): JSX.Element {
  const turn = { transform: `rotate(${-(degrees + (fullSteps === 4 ? 45 : 0))}deg)` };
  if (fullSteps === 4) {
    return (
      <g class="lab-rotor" style={turn}>
        <path class="lab-north" d="M0 -22H34A40 40 0 0 1 34 22H0z" />
        <path class="lab-south" d="M0 -22H-34A40 40 0 0 0 -34 22H0z" />
      </g>
    );
  }
  const teeth = fullSteps / 4;
  let outline = '';
  for (let tooth = 0; tooth < teeth; ++tooth) {
    for (const [part, radius] of [[-0.3, 44], [-0.22, 54], [0.22, 54], [0.3, 44]] as const) {
      const angle = ((tooth + part) * 2 * Math.PI) / teeth;
      outline += `${outline === '' ? 'M' : 'L'}${(radius * Math.cos(angle)).toFixed(2)} ${(radius * Math.sin(angle)).toFixed(2)}`;
    }
  }
  return (
    <g class="lab-rotor" style={turn}>
      <path class="lab-iron" d={`${outline}z`} />
      <path class="lab-index" d="M30 0L43 -5V5z" />
      <circle class="lab-shaft" r="9" />
    </g>
  );
});
