"""docs/reference/json_output.schema.json, closed: a key that it does not name is a fault."""
import json

import jsonschema
from program import ROOT

SCHEMA = json.loads((ROOT / "docs/reference/json_output.schema.json").read_text())


def closed(part):
    """The schema without room for other keys."""
    if isinstance(part, list):
        return [closed(item) for item in part]
    if not isinstance(part, dict):
        return part
    part = {key: closed(value) for key, value in part.items()}
    return {"additionalProperties": False, **part} if "required" in part else part


DEFINITIONS = closed(SCHEMA["$defs"])


def check_json(name, found):
    """Raises where it is not what the definition says."""
    jsonschema.Draft202012Validator(
        {"$defs": DEFINITIONS, "$ref": f"#/$defs/{name.replace(' ', '%20')}"}).validate(found)
    jsonschema.Draft202012Validator(SCHEMA).validate(found)
