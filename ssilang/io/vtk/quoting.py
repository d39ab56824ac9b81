"""XML attributes, without the imports that the standard library's quoting brings along."""

_ENTITIES = str.maketrans({"&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;"})


def quoteattr(text: str) -> str:
    """The text as an XML attribute's value, quotes around it."""
    return f'"{text.translate(_ENTITIES)}"'
