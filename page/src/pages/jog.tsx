// Set up: jog, work zero, homing.
import type { ComponentChildren } from 'preact';
import { say } from '../core/language';
import { notify } from '../core/notices';
import { fromMm, lengthText, lengthUnit, speedText, speedUnit, units } from '../core/units';
import { whyUnable } from '../machine/abilities';
import { whyNoSetUp } from '../machine/actions';
import { machine, status } from '../machine/connection';
import { gamepad } from '../machine/gamepad';
import { fieldHasKeys, jogShare, jogSpeed, jogStep, movesNow, pressByPointer, windowHasFocus, type Direction } from '../machine/jog';
import { pendantWords } from '../machine/pendant';
import { axes } from '../machine/place';
import { goToPlace, home, homeAxis, makeZero, places, vouchForPlace, whyNotPlace } from '../machine/set_up';
import { Button } from '../parts/button';
import { CameraView } from '../parts/camera_view';
import { Icon } from '../parts/icon';
import { Macros } from '../parts/macros';
import { Position } from '../parts/position';
import { Probing } from '../parts/probing';
import { Slider } from '../parts/slider';
import { Choice } from '../parts/view_dialog';

const nameOf = (direction: Direction): string =>
  Object.entries(direction)
    .map(([axis, sign]) => `${axis.toUpperCase()}${sign > 0 ? '+' : '−'}`)
    .join(' ');
const keyOf = (direction: Direction): string =>
  Object.entries(direction)
    .map(([axis, sign]) => axis + (sign > 0 ? '+' : '-'))
    .join(' ');

// Moves while a finger or a mouse button holds it.
function PadButton({ direction, turn, children }: { direction: Direction; turn?: number; children?: ComponentChildren }) {
  const name = nameOf(direction);
  const why = whyNoSetUp('Jog');
  const begin = (event: PointerEvent): void => {
    if (why !== '') notify('refused', why);
    pressByPointer(event, direction);
  };
  return (
    <button
      type="button"
      class={`pad-button ${Object.keys(direction).length > 1 ? 'diagonal' : ''}`}
      data-moves={movesNow.value === keyOf(direction)}
      data-axis={Object.keys(direction).join('')}
      aria-label={say('jog.towards', { direction: name })}
      aria-disabled={why !== ''}
      title={why === '' ? undefined : why}
      onPointerDown={begin}
      onContextMenu={(event) => event.preventDefault()}
    >
      <span style={turn === undefined ? undefined : { transform: `rotate(${turn}deg)` }}>
        <Icon name="up" />
      </span>
      {children}
    </button>
  );
}

function Pad() {
  const others = axes.value.filter((axis) => !'xyz'.includes(axis));
  return (
    <div class="pad-area">
      <div class="pad" role="group" aria-label="X Y">
        <PadButton direction={{ x: -1, y: 1 }} turn={-45} />
        <PadButton direction={{ y: 1 }}>Y+</PadButton>
        <PadButton direction={{ x: 1, y: 1 }} turn={45} />
        <PadButton direction={{ x: -1 }} turn={-90}>
          X−
        </PadButton>
        <div class="pad-middle">
          <b>{jogStep.value === 0 ? '∞' : lengthText(jogStep.value, units.value === 'inch' ? 4 : 2)}</b>
          <span>{jogStep.value === 0 ? '' : lengthUnit()}</span>
        </div>
        <PadButton direction={{ x: 1 }} turn={90}>
          X+
        </PadButton>
        <PadButton direction={{ x: -1, y: -1 }} turn={-135} />
        <PadButton direction={{ y: -1 }} turn={180}>
          Y−
        </PadButton>
        <PadButton direction={{ x: 1, y: -1 }} turn={135} />
      </div>
      {['z', ...others]
        .filter((axis) => axes.value.includes(axis))
        .map((axis) => (
          <div class="pad-column" role="group" aria-label={axis.toUpperCase()} key={axis}>
            <PadButton direction={{ [axis]: 1 } as Direction}>{axis.toUpperCase()}+</PadButton>
            <PadButton direction={{ [axis]: -1 } as Direction} turn={180}>
              {axis.toUpperCase()}−
            </PadButton>
          </div>
        ))}
    </div>
  );
}

// In mm, whatever is shown.
const stepsOf = { mm: [0.01, 0.1, 1, 10, 100], inch: [0.0254, 0.254, 2.54, 25.4, 127] } as const;

const keysStates = ['jog.keys.on', 'jog.keys.field', 'jog.keys.off'] as const;

function JogPanel() {
  const speed = jogSpeed({ x: 1 });
  const steps = stepsOf[units.value];
  const keysMove = windowHasFocus.value && !fieldHasKeys.value;
  const keysState = keysMove ? 'jog.keys.on' : windowHasFocus.value ? 'jog.keys.field' : 'jog.keys.off';
  const keysHelp = jogStep.value === 0 ? 'jog.keys' : 'jog.keys.step';
  const known = jogStep.value === 0 || steps.some((one) => one === jogStep.value);
  return (
    <section class="panel jog" aria-label={say('jog.title')}>
      <Pad />
      <Choice
        title={`${say('jog.step')} (${lengthUnit()})`}
        value={known ? String(jogStep.value) : String(steps[2])}
        all={[['0', say('jog.continuous')], ...steps.map((mm) => [String(mm), String(Number(fromMm(mm).toFixed(4)))] as const)]}
        set={(to) => (jogStep.value = Number(to))}
      />
      <Slider
        class="jog-speed"
        name={say('jog.speed')}
        value={jogShare.value}
        least={0.01}
        step={0.01}
        words={speedText(speed)}
        unit={speedUnit()}
        set={(to) => (jogShare.value = to)}
      />
      <p class={`keys-state ${keysMove ? 'on' : ''}`}>
        <Icon name={keysMove ? 'jog' : 'close'} />
        <span>
          {/* All texts share one place, as high as the longest: a field below that is pressed gets the focus, and must not move away under the pointer. */}
          <span class="same-place">
            {keysStates.map((one) => (
              <span key={one} class={one === keysState ? '' : 'not-now'}>
                <b>{say(one)}</b> <span class="dim">{say(one === 'jog.keys.field' ? 'jog.keys.leave' : keysHelp)}</span>
              </span>
            ))}
          </span>
          {gamepad.value !== '' && <span> {say('jog.gamepad', { name: gamepad.value })}</span>}
          {(status.value?.pendant ?? null) !== null && <span> {pendantWords(status.value?.pendant)}</span>}
        </span>
      </p>
    </section>
  );
}

function SetUpPanel() {
  const why = whyNoSetUp();
  const hasSwitches = machine.value?.axes.some((one) => one.homes) ?? false;
  const xyz = axes.value.filter((axis) => 'xyz'.includes(axis));
  return (
    <section class="panel set-up" aria-label={say('jog.zero')}>
      <h2>{say('jog.zero')}</h2>
      <div class="set-up-buttons">
        {axes.value.map((axis) => (
          <Button key={axis} why={why} onClick={() => makeZero([axis])}>
            {say('jog.zero.axis', { axis: axis.toUpperCase() })}
          </Button>
        ))}
        <Button icon="zero" why={why} onClick={() => makeZero(xyz)}>
          {say('jog.zero.all')}
        </Button>
        <Button
          kind={status.value?.trust === 'homed' ? 'plain' : 'accent'}
          icon="home"
          why={whyUnable('home') || (hasSwitches ? why : say('jog.home.none'))}
          onClick={home}
        >
          {say('jog.home')}
        </Button>
        {hasSwitches &&
          whyUnable('home-axis') === '' &&
          axes.value.map((axis) => (
            <Button key={`home-${axis}`} icon="home" why={why} onClick={() => homeAxis(axis)}>
              {say('jog.home.axis', { axis: axis.toUpperCase() })}
            </Button>
          ))}
        {status.value?.lost_place === true && (
          <Button icon="done" why={why} onClick={vouchForPlace}>
            {say('jog.here')}
          </Button>
        )}
      </div>
    </section>
  );
}

function GoToPanel() {
  const why = whyNoSetUp();
  return (
    <section class="panel set-up" aria-label={say('goto.title')}>
      <h2>{say('goto.title')}</h2>
      <div class="set-up-buttons">
        {places.map((place) => (
          <Button key={place} why={whyNotPlace(place) || why} onClick={() => goToPlace(place)}>
            {say(`goto.${place}`)}
          </Button>
        ))}
      </div>
    </section>
  );
}

export function JogPage() {
  return (
    <div class="jog-page">
      <div class="jog-side">
        <Position />
        <CameraView sets />
        <SetUpPanel />
        <GoToPanel />
        <Macros />
      </div>
      <JogPanel />
      <Probing />
    </div>
  );
}
