"""What the program loads when it starts, and what when it needs it, as the dynamic linker reports it."""
import os
import pathlib
import re

from program import ROOT, SCENES, ProgramTest, main

ROBOT = ROOT / "assets/robots/puma560/puma560.urdf"
MAX_RELOCATIONS = 15000  # 1 us each where symbols are looked up; 70,000 with all libraries


class Start(ProgramTest):
    def linker_reports(self, kind, *words):
        self.twinarm(*words, env=dict(os.environ, LD_DEBUG=kind, LD_DEBUG_OUTPUT=str(self.folder / "linker")))
        reports = list(self.folder.glob("linker.*"))  # of each process
        texts = [report.read_text() for report in reports]
        for report in reports:
            report.unlink()
        return "".join(texts)

    def loaded(self, *words):
        """Names of libraries, without versions."""
        return {pathlib.Path(path).name.split(".")[0]
                for path in re.findall(r"calling init: (\S+)", self.linker_reports("files", *words))}

    def test_the_version_and_the_dynamics_of_a_small_robot_need_no_heavy_library(self):
        for words in (["--version"], ["dynamics", ROBOT]):
            loaded = self.loaded(*words)
            self.assertIn("libstdc++", loaded)
            self.assertFalse(loaded & {"libfcl", "libccd", "libassimp", "libOSMesa"}, loaded)
            relocations = re.findall(r"\s number of (?:relative )?relocations: (\d+)",
                                     self.linker_reports("statistics", *words))
            self.assertLess(sum(map(int, relocations)), MAX_RELOCATIONS)

    def test_meshes_are_read_by_assimp(self):
        scene = self.write("scene.toml", '[[body]]\nname = "b"\nfixed = true\nshape = { mesh = { file = "'
                                         f'{ROOT / "tests/collision/mesh_files/models/tetrahedron.ply"}" }} }}\n')
        self.assertIn("libassimp", self.loaded("simulate", scene, "--duration", 0.001))

    def test_contacts_of_more_than_64_bodies_are_found_by_fcl(self):
        scene = self.write("scene.toml", "".join(
            f'[[body]]\nname = "b{k}"\nshape = {{ sphere = {{ radius = 0.1 }} }}\nmass = 1\nposition = [{k}, 0, 1]\n'
            for k in range(65)))
        self.assertLess({"libfcl", "libccd"}, self.loaded("simulate", scene, "--duration", 0.001))

    def test_the_narrow_phase_of_fcl_is_loaded_by_scenes_that_choose_it(self):
        two = ("simulate", SCENES / "box_stack.toml", "--duration", 0.001)
        self.assertFalse(self.loaded(*two) & {"libfcl", "libccd"})
        self.assertLess({"libfcl", "libccd"}, self.loaded(*two, "--set", "detection=fcl"))

    def test_pictures_are_drawn_by_osmesa(self):
        self.assertIn("libOSMesa", self.loaded("render", SCENES / "incline.toml", "--png", self.folder / "a.png",
                                               "--size", "32x24"))


if __name__ == "__main__":
    main()
