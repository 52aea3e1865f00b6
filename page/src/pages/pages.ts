// The pages: a line each. A page that is large loads when it is first shown.
import type { ComponentType } from 'preact';
import type { Key } from '../core/language';
import type { IconName } from '../parts/icon';

export interface Page {
  path: string;
  title: Key;
  icon: IconName;
  load: () => Promise<ComponentType>;
}

export const pages: readonly Page[] = [
  { path: 'run', title: 'page.run', icon: 'run', load: async () => (await import('./run')).RunPage },
  { path: 'jog', title: 'page.jog', icon: 'jog', load: async () => (await import('./jog')).JogPage },
  { path: 'files', title: 'page.files', icon: 'files', load: async () => (await import('./files')).FilesPage },
  { path: 'cam', title: 'page.cam', icon: 'cam', load: async () => (await import('./cam')).CamPage },
  { path: 'console', title: 'page.console', icon: 'console', load: async () => (await import('./console')).ConsolePage },
  { path: 'pins', title: 'page.pins', icon: 'pins', load: async () => (await import('./pins')).PinsPage },
  { path: 'machine', title: 'page.machine', icon: 'machine', load: async () => (await import('./machine')).MachinePage },
  { path: 'lab', title: 'page.lab', icon: 'lab', load: async () => (await import('../lab/LabPage')).LabPage },
];
