// Dark or light: as the system says, or as the person has chosen.
import { computed, effect, signal } from '@preact/signals';
import { kept, oneOf } from './kept';

export type ThemeChoice = 'system' | 'dark' | 'light';
export const themeChoice = kept<ThemeChoice>('theme', 'system', oneOf('system', 'dark', 'light'));

const systemIsLight = signal(false);
export const theme = computed<'dark' | 'light'>(() =>
  themeChoice.value === 'system' ? (systemIsLight.value ? 'light' : 'dark') : themeChoice.value,
);

export function followTheme(): void {
  const asked = matchMedia('(prefers-color-scheme: light)');
  systemIsLight.value = asked.matches;
  asked.addEventListener('change', () => (systemIsLight.value = asked.matches));
  effect(() => {
    document.documentElement.dataset.theme = theme.value;
  });
}

// The value of a theme variable of style/theme.css, for drawings: '--cut'.
export function themeColour(variable: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(variable).trim();
}
