"""The Octave files: run by GNU Octave, every variable against the reference; the picture is drawn."""

import re
import shutil
import subprocess

import numpy as np
import pytest
from exported import mechanisms, worst_against_reference

from folders import TEMPLATE_FILES
from loaded_mechanisms import SUSPENSION
from mechsheet.compiled import Compiled
from mechsheet.description import load, loads
from mechsheet.exporting import export
from mechsheet.exporting.program import program_of
from mechsheet.shapes.positions import Positions

RUNNER = """
warning('error', 'Octave:undefined-function');
files = dir('*.m');
for k = 1:numel(files)
  name = files(k).name(1:end-2);
  r = feval(name);
  names = fieldnames(r);
  out = fopen([name '.txt'], 'w');
  for n = 1:numel(names)
    if ~isreal(r.(names{n}))
      error('%s.%s is complex', name, names{n});
    end
    fprintf(out, '%s', names{n});
    fprintf(out, ' %.17g', r.(names{n}));
    fprintf(out, '\\n');
  end
  fclose(out);
end
"""


def octave(folder, code):
    command = [shutil.which("octave-cli") or "octave", "--norc", "--no-history", "--no-gui", "--eval", code]
    ran = subprocess.run(
        command, check=False, cwd=folder, capture_output=True, text=True, encoding="utf-8", timeout=240
    )
    # Octave 7 without a display complains about its own end; what the code did before is seen by what it printed
    assert "done" in ran.stdout, ran.stderr[-2000:]
    return ran


def arrays(mechanism, path):
    names = program_of(Compiled(mechanism), ()).shown
    lines = [line.split() for line in path.read_text().splitlines()]
    assert len(lines) == len(names)
    return {name: np.array([float(x) for x in line[1:]]) for name, line in zip(names, lines, strict=True)}


@pytest.mark.ci
@pytest.mark.octave
def test_equal_to_the_reference(tmp_path):
    given = mechanisms(4)
    for name, mechanism in given.items():
        export(mechanism, "octave", tmp_path / f"{name}.m")
    octave(tmp_path, RUNNER + "disp('done')")
    worst = {
        name: worst_against_reference(mechanism, arrays(mechanism, tmp_path / f"{name}.txt"))
        for name, mechanism in given.items()
    }
    assert max(worst.values()) < 1e-9, worst


FLYWHEEL = """
format = 1
mechanism.name = "pump"
links.ground.points = { O = [0, 0] }
links.crank.points = { O = [0, 0], A = [30, 0] }
links.rod.points = { A = [0, 0], B = [100, 0] }
links.piston.points = { B = [0, 0] }
joints = [{ type = "prismatic", link = "piston", on = "ground", point = "B", through = "O", symbol = "s" }]
driver = { link = "crank", start = 0, stop = 360, step = 10, speed = "60 rpm" }
loads = [{ link = "piston", force = ["-100*where(s.v, 1, 0)", 0] }]
flywheel.fluctuation = 0.05
assembly.B = [130, 0]
"""


def test_the_energy_of_a_flywheel_is_left_out_of_the_curves(tmp_path):
    """It is a sum over rows, which the function of one position does not know; the chart beside it is drawn."""
    export(loads(FLYWHEEL, "pump"), "octave", tmp_path / "pump.m")
    text = (tmp_path / "pump.m").read_text(encoding="utf-8")
    assert "E_f" not in text
    assert "result.T12" in text


@pytest.mark.octave
def test_arguments_and_their_faults(tmp_path):
    mechanism = load(next(path for path in TEMPLATE_FILES if path.stem == "slider-crank"))
    export(mechanism, "octave", tmp_path / "slider_crank.m")
    code = """
    r = slider_crank('theta12', pi / 3);
    printf('%.4f %.1f %.1f %.1f %.1f\\n', sin(r.theta13), r.theta13 * 180 / pi, r.s14, r.C_x, r.C_y);
    r = slider_crank('a3', 40, 'theta12', [0, pi / 2]);
    disp(r.s14');
    try, slider_crank('a9', 1); catch problem, disp(problem.message); end
    try, slider_crank('a1'); catch problem, disp(problem.message); end
    disp('done')
    """
    lines = octave(tmp_path, code).stdout.splitlines()
    # the text's calculator example; 89.4 and 0.0932 are its digits
    assert lines[0] == "0.0932 174.7 273.9 176.0 89.4"
    assert lines[1].split()[0] == "84.641"
    assert lines[2].startswith('nothing is called "a9": a1, a2, a3')
    assert lines[3].startswith("arguments come in pairs")


@pytest.mark.cases(2)
@pytest.mark.octave
@pytest.mark.parametrize("name", ["slider-crank", "fivelink", "cylinder-boom"])
def test_picture_without_a_display(name, tmp_path):
    if not shutil.which("gnuplot"):
        pytest.skip("gnuplot is not installed: without a display Octave draws with nothing else")
    mechanism = load(next(path for path in TEMPLATE_FILES if path.stem == name))
    export(mechanism, "octave", tmp_path / "it.m")
    octave(tmp_path, "setenv('DISPLAY', ''); it; disp('done')")
    pictures = [path for path in tmp_path.iterdir() if path.suffix in (".png", ".svg")]
    assert any(path.stem == "it" and path.stat().st_size > 2000 for path in pictures)
    assert len(pictures) > 1


@pytest.mark.octave
def test_numbers_where_nothing_can_be_drawn(tmp_path):
    """Neither a display nor gnuplot: the numbers are told all the same, and that there are no pictures."""
    export(load(next(path for path in TEMPLATE_FILES if path.stem == "four-bar")), "octave", tmp_path / "it.m")
    (tmp_path / "available_graphics_toolkits.m").write_text(
        "function found = available_graphics_toolkits()\n  found = {};\nend\n"
    )
    said = octave(tmp_path, "setenv('DISPLAY', ''); it; disp('done')").stdout
    assert any(line.split()[:1] == ["theta14"] for line in said.splitlines())
    assert "no pictures: this Octave has nothing to draw with" in said
    assert not [path for path in tmp_path.iterdir() if path.suffix in (".png", ".svg")]


DUMP = """
function animate(shapes, paths, pins, dots, rows, middle, h, title_text, file)
  out = fopen('shapes.txt', 'w');
  for k = 1:numel(shapes)
    for r = rows(:)'
      fprintf(out, '%s|%.17g %.17g %.17g %.17g\\n', shapes{k}.name, shapes{k}.x(r, [1 end]), shapes{k}.y(r, [1 end]));
    end
  end
  fclose(out);
end
"""


@pytest.mark.octave
def test_shapes_stand_where_the_list_has_them(tmp_path):
    """The first and the last corner of links and springs in every position: they do not depend on the window."""
    mechanism = loads(SUSPENSION)
    (path,) = export(mechanism, "octave", tmp_path / "it.m")
    text = re.sub(r"(?ms)^function animate\(.*?^end\n", lambda _: DUMP, path.read_text(encoding="utf-8"))
    text = text.replace("if can_draw()", "if true")
    path.write_text(re.sub(r"(?m)^ *curves\(.*\n", "", text), encoding="utf-8")
    octave(tmp_path, "it; disp('done')")
    found = {}
    for line in (tmp_path / "shapes.txt").read_text(encoding="utf-8").splitlines():
        name, numbers = line.split("|")
        found.setdefault(name, []).append([float(number) for number in numbers.split()])
    drawn = Positions(Compiled(mechanism))
    for row in range(drawn.rows):
        for item in drawn.at(row).items:
            if item.kind in ("link", "spring"):
                ends = item.points[[0, -1]].T.ravel()
                assert found[item.name][row] == pytest.approx(ends, abs=1e-8)


def test_same_bytes_and_names(tmp_path):
    mechanism = load(next(path for path in TEMPLATE_FILES if path.stem == "fivelink"))
    first, second = (export(mechanism, "octave", tmp_path / "fivelink.m")[0].read_bytes() for _ in range(2))
    assert first == second
    assert first.startswith(b"function result = fivelink(varargin)")
