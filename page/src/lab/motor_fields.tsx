// The motor, its drive and its load, for the pages of torque and loops.
import type { JSX } from 'preact';
import type { Motor } from './core';
import { Segments } from './shared';
import { change, view } from './state';
import type { LabView } from './view';
import { ViewNumber } from './ViewNumber';
import { say } from './words';

const kgM2PerGCm2 = 1e-7;

// A loop and a torque curve show themselves best with a friction of their own.
export type FrictionField = 'friction' | 'drag';

export function motorOf(now: LabView, friction: FrictionField): Motor {
  return {
    stepsPerTurn: 200,
    rotorInertia: now.gcm2 * kgM2PerGCm2,
    holdingTorque: now.hold,
    current: now.amps,
    resistance: now.ohms,
    inductance: now.mh / 1000,
    supply: now.volts,
    resistive: now.resistive,
    loadInertia: now.loadgcm2 * kgM2PerGCm2,
    friction: now[friction],
  };
}

export function MotorFields({ friction }: { friction: FrictionField }): JSX.Element {
  const now = view.value;
  return (
    <>
      <Segments
        label={say('regulation')}
        value={now.resistive ? 'resistive' : 'chopper'}
        options={[{ value: 'chopper', words: say('chopper') }, { value: 'resistive', words: say('resistive') }]}
        onChange={(value) => change({ resistive: value === 'resistive' })}
      />
      <div class="lab-pair">
        <ViewNumber name="hold" label={say('holdingTorque')} unit="N·m" step={0.05} />
        <ViewNumber name="amps" label={say('current')} unit="A" step={0.1} />
        <ViewNumber name="ohms" label={say('resistance')} unit="Ω" step={0.1} />
        <ViewNumber name="mh" label={say('inductance')} unit="mH" step={0.1} />
        <ViewNumber name="volts" label={say('supply')} unit="V" step={1} />
        <ViewNumber name="gcm2" label={say('rotorInertia')} unit="g·cm²" step={1} />
        <ViewNumber name="loadgcm2" label={say('loadInertia')} unit="g·cm²" step={1} />
        <ViewNumber name={friction} label={say('friction')} unit="N·m" step={0.01} />
      </div>
    </>
  );
}
