// What the address of a page of the site asks for before its #: ?embed&lang=it&theme=light, as the code for embedding has it.
import { keepNothing } from '../core/kept';
import { language, languages, type Language } from '../core/language';
import { themeChoice, type ThemeChoice } from '../core/theme';

const isTheme = (text: string | null): text is ThemeChoice => text === 'light' || text === 'dark' || text === 'system';
const isLanguage = (text: string | null): text is Language => text !== null && text in languages;

// Returns whether the page is embedded. What a link asks for is valid for this visit: the visitor's own choices stay kept.
export function obeyAddress(search: string): boolean {
  const asked = new URLSearchParams(search);
  const [lang, theme] = [asked.get('lang'), asked.get('theme')];
  const isEmbedded = asked.has('embed');
  if (isEmbedded || isLanguage(lang) || isTheme(theme)) keepNothing();
  if (isLanguage(lang)) language.value = lang;
  if (isTheme(theme)) themeChoice.value = theme;
  return isEmbedded;
}

// The code that shows the page at `link` in a page of someone else.
export function embedCode(link: string, title: string, height: number): string {
  const address = new URL(link);
  const asked = new URLSearchParams({ lang: language.value });
  if (themeChoice.value !== 'system') asked.set('theme', themeChoice.value);
  address.search = `?embed&${asked.toString()}`;
  const text = (words: string): string => words.replaceAll('&', '&amp;').replaceAll('"', '&quot;').replaceAll('<', '&lt;');
  return `<iframe src="${text(address.href)}" title="${text(title)}" width="100%" height="${Math.round(height)}" style="border: 0" loading="lazy"></iframe>`;
}
