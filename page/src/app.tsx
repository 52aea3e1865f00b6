// The frame: the state above, the pages' names beside (below on a phone), the actions always at hand.
import { useEffect, useState } from 'preact/hooks';
import type { ComponentType } from 'preact';
import { say } from './core/language';
import { path } from './core/route';
import { isLive } from './machine/connection';
import { pages } from './pages/pages';
import { ActionBar } from './parts/action_bar';
import { ConnectionBanner } from './parts/connection_banner';
import { Notices, QuestionDialog } from './parts/dialogs';
import { Icon } from './parts/icon';
import { InterruptedBanner } from './parts/interrupted_card';
import { StartDialog } from './parts/start_dialog';
import { DiskBanner, FileBanner, OwnerBanner, StateBanner } from './parts/state_banner';
import { WaitBanner } from './parts/wait_banner';
import { openDialog, ViewDialogs } from './parts/view_dialog';

function Navigation() {
  return (
    <nav class="pages" aria-label={say('frame.pages')}>
      {pages.map((page) => (
        <a key={page.path} href={`#/${page.path}`} aria-current={page.path === path.value ? 'page' : undefined}>
          <Icon name={page.icon} />
          <span>{say(page.title)}</span>
        </a>
      ))}
    </nav>
  );
}

function Shown() {
  const page = pages.find((one) => one.path === path.value) ?? pages[0];
  const [loaded, setLoaded] = useState<{ path: string; Content: ComponentType } | null>(null);
  useEffect(() => {
    if (page === undefined) return undefined;
    let wanted = true;
    void page.load().then((Content) => {
      if (wanted) setLoaded({ path: page.path, Content });
    });
    return () => {
      wanted = false;
    };
  }, [page]);
  if (page === undefined) return null;
  const title = say(page.title);
  document.title = `${title} · Passo`;
  return (
    <main id="content" class={`content page-${page.path}`} tabIndex={-1}>
      <h1 class="unseen">{title}</h1>
      {loaded?.path === page.path ? <loaded.Content /> : <p class="dim">{say('frame.loading')}</p>}
    </main>
  );
}

export function App() {
  return (
    <div class={`frame ${isLive.value ? '' : 'not-live'}`}>
      <a class="skip" href="#content" onClick={skip}>
        {say('frame.skip')}
      </a>
      <header class="head">
        <StateBanner />
        <div class="head-buttons">
          <button type="button" class="bare" onClick={() => (openDialog.value = 'view')}>
            <Icon name="view" />
            <span>{say('frame.settings')}</span>
          </button>
          <button type="button" class="bare wide-only" onClick={() => (openDialog.value = 'shortcuts')}>
            <Icon name="help" />
            <span>{say('frame.shortcuts')}</span>
          </button>
        </div>
      </header>
      <div class="banners">
        <ConnectionBanner />
        <OwnerBanner />
        <FileBanner />
        <DiskBanner />
        <WaitBanner />
        <InterruptedBanner />
      </div>
      <Shown />
      <ActionBar />
      <Navigation />
      <Notices />
      <QuestionDialog />
      <StartDialog />
      <ViewDialogs />
    </div>
  );
}

function skip(event: MouseEvent): void {
  event.preventDefault();
  document.getElementById('content')?.focus();
}
