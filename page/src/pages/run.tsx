// Run: the position, the program on its way, and the scene.
import { CameraView } from '../parts/camera_view';
import { FirstStart } from '../parts/first_start';
import { InterruptedCard } from '../parts/interrupted_card';
import { JobProgress } from '../parts/job_progress';
import { Overrides } from '../parts/overrides';
import { Position } from '../parts/position';
import { ProgramView } from '../parts/program_view';
import { SceneView } from '../scene/scene_view';

export function RunPage() {
  return (
    <>
      <InterruptedCard />
      <FirstStart />
      <div class="run">
        <Position />
        <JobProgress />
        <Overrides />
        <div class="panel scene-panel">
          <SceneView />
          <CameraView />
        </div>
        <ProgramView />
      </div>
    </>
  );
}
