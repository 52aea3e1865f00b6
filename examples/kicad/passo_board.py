"""KiCad action plugin: the programs of the open board, by `passo cam board`.

Copy this file into KiCad's plugin folder (Tools > External Plugins > Open Plugin Directory), and refresh the plugins.
The button saves nothing: what is on disk is read. Zones are read as they are filled: fill them (B) and save before.

PASSO         the program, if it is not in the path
PASSO_OPTIONS further options, as "-m /home/me/router.toml --profile /home/me/board.toml"
"""
import os
import pathlib
import shlex
import subprocess
import webbrowser


def make(board_file, run=subprocess.run):
    """Makes the programs beside the board. Returns the page that says what to do when, and what the command said."""
    if not board_file:
        raise RuntimeError("The board has no file yet: save it first.")
    folder = os.path.splitext(board_file)[0] + "-passo"
    command = [os.environ.get("PASSO", "passo"), "cam", "board", board_file, "-o", folder]
    done = run(command + shlex.split(os.environ.get("PASSO_OPTIONS", "")), stdout=subprocess.PIPE,
               stderr=subprocess.STDOUT, encoding="utf-8", errors="replace")
    if done.returncode != 0:
        raise RuntimeError(done.stdout)
    return os.path.join(folder, "board.html"), done.stdout


if __name__ == "__main__":
    import sys

    print(make(sys.argv[1])[0])
else:
    import pcbnew
    import wx

    class PassoBoard(pcbnew.ActionPlugin):
        def defaults(self):
            self.name = "Passo: drill, mill and cut out"
            self.category = "Manufacturing"
            self.description = "Makes the programs of this board, and opens the page that says what to do when"
            self.show_toolbar_button = True

        def Run(self):
            board_file = pcbnew.GetBoard().GetFileName()
            try:
                page, _ = make(board_file)
            except (OSError, RuntimeError) as problem:
                wx.MessageBox(str(problem), "Passo", wx.OK | wx.ICON_ERROR)
                return
            webbrowser.open(pathlib.Path(page).resolve().as_uri())

    PassoBoard().register()
