// What others call this page: by its device and browser, or as its person says.
import { say } from '../core/language';
import { kept } from '../core/kept';

const isText = (value: unknown): value is string => typeof value === 'string';
export const givenName = kept('page-name', '', isText);
export const longestName = 40;

interface Agent {
  userAgent: string;
  brands: readonly string[]; // as the browser tells them apart from its userAgent; some do not
  touches: boolean;
}

// The first that fits counts: most browsers say that they are several others, too.
const browsers: readonly [RegExp, string][] = [
  [/Edg(e|A|iOS)?\//, 'Edge'],
  [/OPR\/|Opera/, 'Opera'],
  [/SamsungBrowser\//, 'Samsung Internet'],
  [/Firefox\/|FxiOS\//, 'Firefox'],
  [/HeadlessChrome\/|Chromium\//, 'Chromium'],
  [/Chrome\/|CriOS\//, 'Chrome'],
  [/Safari\//, 'Safari'],
];
const systems: readonly [RegExp, string][] = [
  [/Android/, 'Android'],
  [/iPhone/, 'iPhone'],
  [/iPad/, 'iPad'],
  [/CrOS/, 'ChromeOS'],
  [/Windows/, 'Windows'],
  [/Mac OS X|Macintosh/, 'macOS'],
  [/Linux|X11/, 'Linux'],
];
const firstOf = (all: readonly [RegExp, string][], text: string): string | undefined => all.find(([mark]) => mark.test(text))?.[1];

export function deviceName({ userAgent, brands, touches }: Agent): string {
  const named = firstOf(browsers, userAgent) ?? 'Browser';
  const isChromium = named === 'Chrome' && brands.includes('Chromium') && !brands.includes('Google Chrome');
  const system = firstOf(systems, userAgent);
  const device = system === 'macOS' && touches ? 'iPad' : system; // an iPad says that it is a Mac
  return `${isChromium ? 'Chromium' : named}${device === undefined ? '' : ` on ${device}`}`;
}

type Brands = { userAgentData?: { brands: readonly { brand: string }[] } };
export function ownDevice(): string {
  const brands = (navigator as Navigator & Brands).userAgentData?.brands.map((one) => one.brand) ?? [];
  return deviceName({ userAgent: navigator.userAgent, brands, touches: navigator.maxTouchPoints > 1 });
}
export const pageName = (): string => givenName.value.trim().slice(0, longestName) || ownDevice();

// "Firefox on Android" in the language of the page. Other names stay as they were given.
export function nameInWords(name: string): string {
  const device = systems.map(([, system]) => system).find((system) => name.endsWith(` on ${system}`));
  return device === undefined ? name : say('owner.device', { browser: name.slice(0, -` on ${device}`.length), device });
}
