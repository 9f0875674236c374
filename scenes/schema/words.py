"""The words that the schema is written in: numbers with ranges, objects with keys, unions by "type". Knows nothing of scenes."""
import re

INF = float("inf")
definitions = {}


def ref(name):
    return {"$ref": f"#/definitions/{name}"}


def number(text, low=-INF, high=INF, open_low=False, open_high=False, default=None, kind="number"):
    """A number in a range; `open_` ends do not belong to it."""
    schema = {"type": kind, "description": text}
    if low > -INF:
        schema["exclusiveMinimum" if open_low else "minimum"] = low
    if high < INF:
        schema["exclusiveMaximum" if open_high else "maximum"] = high
    if default is not None:
        schema["default"] = default
    return schema


def integer(text, low, high, default=None):
    return number(text, low, high, default=default, kind="integer")


def positive(text, default=None):
    return number(text, 0, open_low=True, default=default)


def fraction(text, default=None):
    return number(text, 0, 1, default=default)


def boolean(text, default=None):
    return {"type": "boolean", "description": text, **({} if default is None else {"default": default})}


def string(text, **more):
    return {"type": "string", "description": text, **more}


def choice(text, *values, default=None):
    return {"enum": list(values), "description": text, **({} if default is None else {"default": default})}


def numbers(text, count, item=None):
    return {"type": "array", "description": text, "items": item or {"type": "number"}, "minItems": count, "maxItems": count}


def vector(text):
    return numbers(text, 3)


def listed(text, item, least=0):
    return {"type": "array", "description": text, "items": item, **({"minItems": least} if least else {})}


def described(schema, text, default=None):
    """A reference with a text of its own (draft 7 ignores what stands beside $ref)."""
    return {"description": text, "allOf": [schema], **({} if default is None else {"default": default})}


def spellings(name, separators):
    return "^" + re.sub("[ _-]", separators, name) + "$"


def keyed(text, properties, required=(), example=None, **more):
    """An object of these keys and no others."""
    patterns = {}
    for key, schema in properties.items():
        if re.search("[ _]", key):
            patterns[f"^(?!{key}$){spellings(key, '[ _]')[1:]}"] = schema
    schema = {"type": "object", "description": text, "properties": properties, "additionalProperties": False}
    if patterns:
        schema["patternProperties"] = patterns
    if required:
        schema["required"] = list(required)
    if example is not None:
        schema["examples"] = [example]
    return {**schema, **more}


def type_name(text, names, more=()):
    """The value of "type": the documented names are offered, their other spellings accepted."""
    return {"type": "string", "description": text,
            "anyOf": [{"enum": list(names)}, {"pattern": "|".join(spellings(n, "[ _-]") for n in [*names, *more])}]}


def union(text, family, names, aliases=None, default=None):
    """One of the definitions "FAMILY: NAME" by the value of "type"."""
    aliases = aliases or {}
    cases = []
    for name in names:
        all_names = [name, *aliases.get(name, ())]
        match = {"properties": {"type": {"pattern": "|".join(spellings(n, "[ _-]") for n in all_names)}}}
        if name != default:
            match["required"] = ["type"]
        prefix = family if isinstance(family, str) else family[name]
        cases.append({"if": match, "then": ref(f"{prefix}: {name}")})
    return {"type": "object", "properties": {"type": type_name(text, names, [a for n in names for a in aliases.get(n, ())])},
            **({} if default else {"required": ["type"]}), "allOf": cases}
