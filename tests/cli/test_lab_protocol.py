"""Messages and commands of the lab against app/web/src/protocol."""
import json
import re

from lab_test import LabTest
from program import ROOT, main

FOLDER = ROOT / "app/web/src/protocol"
TEXT = "".join(re.sub(r"(?<!:)//.*", "", (FOLDER / f"{name}.ts").read_text())
               for name in ("run", "inspection", "messages"))
SIMPLE = {"string": str, "number": (int, float), "boolean": bool, "null": type(None)}
WORD = re.compile(r"'[^']*'|\w+|\S")


class Types:
    """Fields of TypeScript interfaces: name to (is optional, tokens of its type)."""

    def __init__(self, text):
        self.extends = dict(re.findall(r"interface (\w+) extends Partial<(\w+)>", text))
        self.alias = {name: WORD.findall(words) for name, words in re.findall(r"type (\w+) =([^;]*);", text)
                      if name != "Command"}
        self.fields = {name: self.read(WORD.findall(body))
                       for name, body in re.findall(r"interface (\w+)[^{]*\{(.*?)\n\}", text, re.S)}

    @staticmethod
    def read(words):
        """Of the text between braces."""
        fields, at = {}, 0
        while at < len(words):
            name, is_optional = words[at], words[at + 1] == "?"
            at = end = at + (3 if is_optional else 2)
            depth = 0
            while end < len(words) and (depth or words[end] != ";"):
                depth += (words[end] in "{[<(") - (words[end] in "}]>)")
                end += 1
            fields[name] = (is_optional, words[at:end])
            at = end + 1
        return fields

    def of(self, name):
        partial = self.fields[self.extends[name]] if name in self.extends else {}
        return {key: (True, words) for key, (_, words) in partial.items()} | self.fields[name]

    def faults(self, value, words, where):
        """Paths at which a value does not have its type."""
        parts, depth, part = [], 0, []
        for word in [*words, "|"]:
            depth += (word in "{[<(") - (word in "}]>)")
            if word == "|" and depth == 0:
                parts, part = parts + [part] if part else parts, []
            else:
                part.append(word)
        all_faults = [self.faults_of_one(value, one, where) for one in parts]
        return min(all_faults, key=len)

    def faults_of_one(self, value, words, where):
        wrong = [f"{where}: {' '.join(words)}, but {json.dumps(value)[:80]}"]
        if words[-2:] == ["[", "]"]:
            inner = words[:-2]
            inner = inner[1:-1] if inner[0] == "(" else inner
            if not isinstance(value, list):
                return wrong
            return [fault for i, item in enumerate(value) for fault in self.faults(item, inner, f"{where}[{i}]")]
        if words[-1] == "]" and words[0] == "[":  # a tuple of numbers
            return [] if isinstance(value, list) and len(value) == words.count("number") else wrong
        if words[0] in ("Record", "Omit"):
            if words[0] == "Omit":
                left = {key: type_ for key, type_ in self.of(words[2]).items() if f"'{key}'" not in words}
                return self.object_faults(value, left, where) if isinstance(value, dict) else wrong
            return [] if all(isinstance(item, (int, float)) for item in value.values()) else wrong
        if words[-1] == "]":  # Channel['kind']
            return self.faults(value, self.of(words[0])[words[2].strip("'")][1], where)
        if words[0] == "{":
            return self.object_faults(value, self.read(words[1:-1]), where) if isinstance(value, dict) else wrong
        word = words[0]
        if word in self.fields:
            return self.object_faults(value, self.of(word), where) if isinstance(value, dict) else wrong
        if word in self.alias:
            return self.faults(value, self.alias[word], where)
        if word in SIMPLE:
            is_it = isinstance(value, SIMPLE[word]) and (word != "number" or not isinstance(value, bool))
            return [] if is_it else wrong
        expected = {"true": True, "false": False}.get(word, word.strip("'"))
        return [] if value == expected else wrong

    def object_faults(self, value, fields, where):
        faults = [f"{where}: no {key}" for key, (is_optional, _) in fields.items()
                  if not is_optional and key not in value]
        faults += [f"{where}: {key} is not in the description" for key in value if key not in fields]
        return faults + [fault for key in value if key in fields
                         for fault in self.faults(value[key], fields[key][1], f"{where}.{key}")]


class LabProtocol(LabTest):
    types = Types(TEXT)

    def check(self, name, message):
        self.assertEqual(self.types.faults(message, [name], name), [])

    def test_messages_have_the_described_keys_and_types(self):
        self.live.do("inspect", on=True, body=1)
        self.check("SceneMessage", self.live.wait_for("scene"))
        self.check("BodyInspection", self.live.wait_for("inspection"))
        self.frame(lambda f: f.time > 0.1)
        self.stand()
        self.live.do("inspect", on=True, body=2)
        self.check("BodyInspection", self.live.wait_for("inspection", lambda g: g["paused"]))
        self.live.do("nonsense")
        self.live.do("branch", at=0.05, changes=["coupling[0].stiffness=1e8"])
        self.live.do("play", on=True)
        diverged = self.state(lambda s: s["failure"] and not s["failure"]["trying"])
        self.assertTrue(diverged["branch"] and diverged["failure"]["remedies"] and diverged["notes"])
        self.check("StateMessage", diverged)

    def test_a_frame_has_the_described_arrays(self):
        table = re.search(r"const ARRAYS = \{(.*?)\n\}", (FOLDER / "frame.ts").read_text(), re.S)[1]
        rows = re.findall(r"(\w+): \[(\w+)Array, '([^']+)', (\d)\]", table)
        codes = {"Float64": "d", "Float32": "f", "Int16": "h", "Uint32": "I", "Uint16": "H", "Uint8": "B"}
        frame = self.frame(lambda f: f.instances > 0)
        counts = {"channels": len(frame.channels), "works": len(frame.works), "bodies": len(frame.link) // 7,
                  "instances": frame.instances, "labels": frame.labels, "layers and an end": frame.layers + 1}
        own = {"flags": "instance_flags"}
        arrays = [value for value in vars(frame).values() if isinstance(value, memoryview)]
        for (name, kind, of, width), array in zip(rows, arrays):
            named = getattr(frame, own.get(name, re.sub(r"([A-Z])", lambda m: "_" + m[1].lower(), name)))
            self.assertIs(named, array, name)  # in the same order
            self.assertEqual((array.format, len(array)), (codes[kind], int(width) * counts[of]), name)
        self.assertEqual(len(rows), len(arrays) + 1)  # and the text

    def test_described_commands_are_those_of_the_program(self):
        said = {}
        union = re.search(r"type Command =(.*\}) *;", TEXT, re.S)[1]
        for form in re.findall(r"\{(.*?)\}", union):
            fields = self.types.read(WORD.findall(form))
            name = fields.pop("do")[1][0].strip("'")
            said[name] = {key: absent or key == "stamp" for key, (absent, _) in fields.items()}
        source = (ROOT / "app/lab/session/lab_command.cpp").read_text()
        made = r'(?:field|whole_number|angle)\(\s*"(\w+)"[^()]*?(, true)?\)'
        shared = {name: (key, bool(absent))
                  for name, key, absent in re.findall(r"const Field (\w+) *= *" + made, source)}
        shared |= {name: (key, False) for name, key in re.findall(r'const Field (\w+)\{"(\w+)"', source)}
        table = source[source.index("static const std::vector<Form> all"):source.index("return all;")]
        read = {}
        form = r'\{"(\w+)",\s*(?:true|false),'
        for name, rest in re.findall(form + r'(.*?)(?=\{"\w+",\s*(?:true|false)|\Z)', table, re.S):
            own = {key: bool(absent) for key, absent in re.findall(made, rest)}
            own |= {"body": flag == "true" for flag in re.findall(r"body\((true|false)\)", rest)}
            also = dict(shared[word] for word in re.findall(r"[{\s](\w+)[,}]", rest) if word in shared)
            read[name] = own | also
        self.assertEqual(said, read)


if __name__ == "__main__":
    main()
