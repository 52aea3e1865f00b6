// A share from 0 to 1 with its meaning in words. Screen readers hear the words, too.
interface SliderProps {
  class: string;
  name: string;
  hidesName?: boolean;
  value: number;
  least?: number;
  step: number;
  words: string; // what the value means
  unit?: string;
  set: (to: number) => void;
}

export function Slider({ class: kind, name, hidesName = false, value, least = 0, step, words, unit, set }: SliderProps) {
  return (
    <label class={kind}>
      <span class={hidesName ? 'unseen' : 'dim'}>{name}</span>
      <input
        type="range"
        min={least}
        max="1"
        step={step}
        value={value}
        aria-valuetext={unit === undefined ? words : `${words} ${unit}`}
        onInput={(event) => set(Number(event.currentTarget.value))}
      />
      <b class="figure">
        {words} {unit !== undefined && <span class="unit">{unit}</span>}
      </b>
    </label>
  );
}
