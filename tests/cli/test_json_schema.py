"""What each command prints with --json, against docs/reference/json_output.schema.json, which must know every key."""
import json
import re

from json_schema import SCHEMA, check_json
from program import ProgramTest, main, run, start
from waiting import TIMEOUT

PUMA = "assets/robots/puma560/puma560.urdf"
SCENES = "assets/scenes"
MAP = f"map {SCENES}/tracking_map.toml --x coupling.stiffness:1e4:1e6:4:log --y step:1e-3:1e-2:4:log --duration 0.1"
# Definition: command lines; {out} is an empty folder. The first ones make recordings for the later ones.
LINES = {
    "simulate": [f"simulate {SCENES}/hand_and_obstacles.toml --duration 0.2 --every 0.1 --record {{out}}/a.twinrec",
                 f"simulate {PUMA} --duration 0.01 --floating", f"simulate {PUMA} --duration 0.01 --integrator dopri5",
                 "simulate tests/data/ball_joint.urdf --duration 0.01", f"simulate {SCENES}/bouncing_ball.toml",
                 f"simulate {SCENES}/pendulum.toml --duration 5 --energy-bound 3 --post-mortem {{out}}/p.twinrec"],
    "compare": ["compare A1 --integrator rk4,dopri5", "compare A1 --html {out}"],
    "coupling gains": ["coupling gains --inertia 0.5 --frequency 8 --damping-ratio 1",
                       f"coupling gains {SCENES}/robot_beside_obstacles.toml"],
    "coupling predict": [f"coupling predict {SCENES}/robot_beside_obstacles.toml --wall 1000",
                         "coupling predict tests/data/god_object.toml"],
    "dynamics": [f"dynamics {PUMA} --floating", "dynamics tests/data/ball_joint.urdf"],
    "dynamics --kinematics": [f"dynamics {PUMA} --kinematics"],
    "errors": ["fly", "simulate nothing.urdf", "study --device mouse"],
    "export": ["export {out}/a.twinrec"],
    "export page": ["export {out}/a.twinrec {out}/a.html"],
    "hand": [f"hand {SCENES}/hand_and_obstacles.toml --simulated --duration 0.2 --record --out {{out}}/hand",
             f"hand {SCENES}/hand_and_obstacles.toml --duration 2.5 --empty-loop --out {{out}}/hand"],
    "inspect": ["inspect {out}/a.twinrec --at 0.1", f"inspect {SCENES}/slider_crank.toml"],
    "map": [MAP + " --checkpoint {out}/m.twinmap"],
    "map --cell": [MAP + " --cell 1,1 --record {out}/cell.twinrec"],
    "map --job": [MAP + " --jobs 1 --job 0 --checkpoint {out}/j.twinmap"],
    "modes": [f"modes {SCENES}/slider_crank.toml"],
    "render": ["render {out}/a.twinrec --png {out}/a.png --size 64x64"],
    "replay": ["replay {out}/a.twinrec --set gravity=0,0,-3"],
    "trial": ["trial --device virtual:synthetic --simulated --yes --seconds 1 --time-limit 1 --out {out}/trial"],
    "zwidth": ["zwidth --delay 1"],
}
ELSEWHERE = {"lab", "study", "study --identify-one"}  # below, test_command_line.py, test_identify.py


class JsonSchema(ProgramTest):
    def test_each_command_prints_what_the_schema_says_and_no_other_key(self):
        for name, lines in LINES.items():
            for line in lines:
                with self.subTest(line):
                    check_json(name, json.loads(run(*line.format(out=self.folder).split(), "--json").stdout))

    def test_a_diverged_run_and_an_alarm_are_in_the_schema(self):
        found = json.loads(run(*LINES["simulate"][-1].format(out=self.folder).split(), "--json").stdout)
        self.assertIn("post_mortem", found)

    def test_the_lab_prints_one_line(self):
        lab = start("lab", "--json", "--no-browser")
        check_json("lab", json.loads(lab.stdout.readline()))
        lab.terminate()
        lab.communicate(timeout=TIMEOUT)

    def test_every_command_with_json_has_a_definition(self):
        tree = run("help", "--man").stdout
        names = {section.splitlines()[0].strip().replace("\\-", "-") for section in tree.split(".SS ")[1:]
                 if "\\-\\-json" in section}
        self.assertGreater(len(names), 12)
        self.assertLessEqual(names, set(SCHEMA["$defs"]))
        self.assertLessEqual(set(LINES) | ELSEWHERE, set(SCHEMA["$defs"]))
        commands = {name for name in SCHEMA["$defs"] if re.split(" ", name)[0] in {n.split()[0] for n in names}}
        self.assertEqual(commands - set(LINES) - ELSEWHERE, set())


if __name__ == "__main__":
    main()
