// The lab as a page of its own: no server, no machine.
import { LabPage } from '../lab/LabPage';
import { showOnSite } from './frame';
import { EmbedLab, WholeLab } from './embed_lab';

function Lab({ embedded }: { embedded: boolean }) {
  if (!embedded) return <LabPage share={<EmbedLab />} />;
  return (
    <LabPage embedded>
      <WholeLab />
    </LabPage>
  );
}
showOnSite('lab', Lab);
