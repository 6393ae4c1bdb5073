"""Files that are as large, as deep or as long as somebody means them to be: refused in seconds, within a
gigabyte. What small files can do is tried by tests/fuzz."""
import os
import pathlib
import resource
import struct
import subprocess
import tempfile

import program
import recording_format as form
from program import ROOT, SCENES, ProgramTest, main

GIGABYTE = 1 << 30
SECONDS = 10  # of processor time; what they take is a tenth of it
ARM = (b'<robot name="r"><link name="a"/><link name="b"><inertial><mass value="1"/><inertia ixx="1" ixy="0" '
       b'ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link><joint name="j" type="continuous">'
       b'<parent link="a"/><child link="b"/></joint></robot>')
BALL = b'duration = 0.01\n[[body]]\nname = "ball"\nshape = { sphere = { radius = 0.1 } }\nmass = 1\n'


def limited():
    """More than the limits is a crash, not a wait."""
    if "asan" not in program.PROGRAM:  # sanitizers reserve terabytes of addresses
        resource.setrlimit(resource.RLIMIT_DATA, (GIGABYTE, GIGABYTE))
    resource.setrlimit(resource.RLIMIT_CPU, (SECONDS, SECONDS))


class HostileFiles(ProgramTest):
    def write(self, name, data):
        (self.folder / name).write_bytes(data)
        return self.folder / name

    def reported(self, *command, code=2):
        """What the program says; it refuses, and does not break."""
        done = self.twinarm(*command, code=code, errors="replace", preexec_fn=limited, cwd=self.folder)
        self.assertLess(len(done.stderr), 1 << 20)
        return done.stderr

    def refused(self, words, *command):
        self.assertIn(words, self.reported(*command))

    def test_a_robot_of_a_million_links(self):
        links = b"".join(b'<link name="%d"/><joint name="%d" type="fixed"><parent link="%d"/><child link="%d"/>'
                         b"</joint>" % (n, n, n, n + 1) for n in range(1000000))
        self.refused("larger than 16 MiB", "dynamics", self.write("a.urdf", b"<robot>" + links + b"</robot>"))

    def test_a_robot_that_is_all_faults(self):
        for part in (b"<link/>", b"<joint/>", b"<material/>", b"<a/>", b"<link><inertial/></link>",
                     b'<link name="a"><visual/></link>'):
            text = b"<robot name='r'>" + part * ((15 << 20) // len(part)) + b"</robot>"
            self.reported("dynamics", self.write("a.urdf", text))

    def test_a_long_chain_is_computed(self):
        """Ten thousand links, the last of them first: each reader walks it once."""
        count = 10000
        links = b"".join(b'<link name="%d"/>' % n for n in range(count))
        joints = b"".join(b'<joint name="%d" type="fixed"><parent link="%d"/><child link="%d"/></joint>'
                          % (n, n, n + 1) for n in reversed(range(count - 1)))
        self.reported("dynamics", self.write("a.urdf", b'<robot name="r">' + links + joints + b"</robot>"), code=0)

    def chain(self, count):
        link = ('<link name="l{1}"><inertial><mass value="1"/>'
                '<inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>'
                '<joint name="j{1}" type="continuous"><parent link="l{0}"/><child link="l{1}"/>'
                '<origin xyz="0.1 0 0"/><axis xyz="0 1 0"/></joint>')
        text = '<link name="l0"/>' + "".join(link.format(n, n + 1) for n in range(count))
        return self.write("chain.urdf", f'<robot name="r">{text}</robot>'.encode())

    def test_a_long_chain_that_moves_is_computed_without_dense_matrices_and_refused_where_they_are_needed(self):
        chain = self.chain(10000)
        self.assertIn("mass matrix is left out", self.reported("dynamics", chain, code=0))
        self.reported("simulate", chain, "--duration", 0.01, code=0)
        for command in (["modes", chain], ["inspect", chain],
                        ["coupling", "predict", chain, "--link", "l9", "--stiffness", 1]):
            self.refused("more than 1000", *command)

    def test_the_program_is_linked_and_compiled_against_what_faults_could_be_used_for(self):
        if "san" in program.PROGRAM:
            return  # sanitizers see more
        dynamic = subprocess.run(["readelf", "--wide", "-dhl", program.PROGRAM], capture_output=True, text=True).stdout
        for word in ("Position-Independent", "GNU_RELRO", "BIND_NOW"):
            self.assertIn(word, dynamic)
        names = subprocess.run(["nm", "-D", program.PROGRAM], capture_output=True, text=True).stdout
        self.assertIn("__stack_chk_fail", names)
        self.assertRegex(names, "__[a-z]+_chk@")

    def test_ctrl_c_ends_what_computes_long_in_one_go(self):
        self.interrupted("modes", self.chain(900))

    def test_a_scene_nested_as_deep_as_its_size_allows(self):
        for text in (b".".join([b"a"] * 500000) + b" = 1\n", b"a = " + b"[" * 1000000, b"a = { b = " * 300000,
                     b"[" + b".".join([b"'a'"] * 300000) + b"]\n", (b"a." * 100 + b"a = { ") * 2000):
            self.refused("depth exceeds 200", "simulate", self.write("a.toml", text), "--duration", "1")

    def test_dots_in_texts_and_comments_are_not_depth(self):
        dots = b"." * 1000
        text = (b"# " + dots + b"[[[\n" + b'note = "' + dots + b'\\"[[{"\n' + BALL + b"friction = 0.5 # " + dots +
                b"\n")
        self.reported("simulate", self.write("a.toml", text), code=0)

    def test_a_scene_as_large_as_it_may_be(self):
        many = 4 << 20
        for part in (b"[[body]]\n", b'[[body]]\nname="a"\n', b"a%d = 1\n", b'[[body]]\nname="a%d"\n'):
            text = b"".join(part.replace(b"%d", b"%d" % n) for n in range(many // (len(part) + 5)))
            self.reported("simulate", self.write("a.toml", text), "--duration", "1")
        self.reported("simulate", self.write("a.toml", b"gravity = [" + b"1," * (2000000) + b"]\n"), "--duration", "1")
        self.refused("4 MiB", "simulate", self.write("a.toml", BALL + b"#" * many))

    def test_a_state_as_large_as_it_may_be(self):
        robot = self.write("a.urdf", ARM)
        keys = b",".join(b'"%d":1' % n for n in range(350000))
        for text in (b"[" * 1000000, b"[" + b"1," * 2000000 + b"1]", b"{" + keys + b"}", b'{"q":{' + keys + b"}}",
                     b'{"q":{"j":"' + b"a" * 4000000 + b'"}}'):
            self.reported("dynamics", robot, "--state", self.write("a.json", text))
        self.refused("4 MiB", "dynamics", robot, "--state", self.write("a.json", b" " * (5 << 20)))

    def test_a_hand_that_is_one_line_or_never_ends(self):
        scene = (b'[[robot]]\nname = "r"\nmodel = "a.urdf"\n[[coupling]]\ntype = "torsional"\nmeasure = "joint"\n'
                 b'link = "b"\nstiffness = 1\ntarget = "hand.csv"\n')
        self.write("a.urdf", ARM)
        file = self.write("a.toml", BALL + scene)
        self.write("hand.csv", b"1," * (10 << 20))
        self.refused("64 KiB", "simulate", file)
        self.write("hand.csv", b"\n" * (1 << 20))
        self.refused("hand.csv", "simulate", file)

    def test_a_pipe_without_a_writer_is_refused_wherever_a_file_is_read(self):
        pendulum, hand = ROOT / "assets/robots/teaching/pendulum.urdf", SCENES / "hand_and_obstacles.toml"
        for name in ("x.urdf", "x.toml", "x.twinrec", "x.json", "x.csv", "x.stl", "x.png"):
            os.mkfifo(self.folder / name)
        for command in (("dynamics", "x.urdf"), ("simulate", "x.toml", "--duration", "1"), ("inspect", "x.twinrec"),
                        ("export", "x.twinrec", "--json"), ("replay", "x.twinrec"), ("make-robot", "x.toml"),
                        ("dynamics", pendulum, "--state", "x.json"), ("study", "--trace", "x.csv"),
                        ("hand", hand, "--device", "virtual:trace:x.csv", "--duration", "1")):
            self.refused("is a device or a pipe", *command)
        for shape in (b"shape = { mesh = { file = 'x.stl' } }\n", b"texture = 'x.png'\n"):
            scene = self.write("b.toml", b"[[body]]\nname = 'b'\nfixed = true\n" + shape)
            self.refused("x.", "render", scene, "--png", "out.png")

    def recorded(self, change):
        file = self.folder / "run.twinrec"
        self.reported("simulate", self.write("a.toml", BALL), "--record", file, code=0)
        found = form.blocks(file.read_bytes())
        file.write_bytes(form.file_of(change(found)))
        return file

    def test_a_recording_that_claims_more_than_it_holds(self):
        def claims(count):
            def change(found):
                frame, = (payload for kind, payload in form.frame_blocks([(form.frames(found)[-1][0], b"")])
                          if kind == "F")
                start, *coded = form.parts_of_frame(frame)
                plain = form.Coder().decoded(*coded)
                bad = form.frame_payload(start, *form.Coder().encoded(struct.pack("<Q", count) + plain[8:]))
                return [*found[:-2], ("S", form.compressed(b"")), ("F", bad)]
            return change
        for count in (1 << 60, (1 << 64) - 1, 1 << 32):
            self.reported("export", self.recorded(claims(count)), "--csv")
        errors = self.faults("export", self.recorded(claims(1 << 32)), "--json")  # one object, though others are whole
        self.assertEqual([error["code"] for error in errors], ["recording.numbers"])
        part = self.recorded(lambda found: found)
        with part.open("ab") as out:
            out.write(b"F" + struct.pack("<I", 0xffffffff))
            out.truncate(3 << 30)  # a hole: takes no room on the disk
        self.reported("export", part, "--csv", code=0)

    def test_a_recording_writes_nothing_outside_of_its_own_folder(self):
        """Its files bear paths; one of them leads upwards from wherever it is unpacked."""
        def change(found):
            header = form.header(found)
            header["files"] += ["../" * 20 + str(self.folder)[1:] + "/planted", "../planted_too"]
            return [*form.with_header(found, header)[:1], *found[1:2], ("D", b"here"), ("D", b"here"), *found[2:]]
        self.refused("not absolute", "replay", self.recorded(change))
        self.assertFalse((self.folder / "planted").exists())
        self.assertFalse((pathlib.Path(tempfile.gettempdir()) / "planted_too").exists())

    def test_a_recording_leaves_nothing_behind_where_it_cannot_be_unpacked(self):
        def change(found):
            header = form.header(found)
            header["files"] += ["/a", "/a/b"]  # a file, and a folder of the same name
            return [*form.with_header(found, header)[:1], *found[1:2], ("D", b""), ("D", b""), *found[2:]]
        file = self.recorded(change)
        os.mkdir(self.folder / "tmp")
        os.environ["TMPDIR"] = str(self.folder / "tmp")
        self.addCleanup(os.environ.pop, "TMPDIR")
        self.reported("replay", file)
        self.assertEqual(list((self.folder / "tmp").iterdir()), [])


if __name__ == "__main__":
    main()
