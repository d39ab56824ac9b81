"""Files that keep the objects of a script between two runs (SAUV, REST).

A file is a zip of `objects.json` (a list of objects that refer to one another by number, and the
records: labels and names) and `arrays/N.npy`. Nothing in it is ever executed: objects are built
from a fixed list of classes, arrays are read without pickles.
"""

from ssilang.io.archive.container import Archive, Encoder, Record, read_archive, write_archive
from ssilang.io.archive.decoding import Decoder

__all__ = ["Archive", "Decoder", "Encoder", "Record", "read_archive", "write_archive"]
