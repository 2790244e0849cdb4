"""Files of others: the one way in which they are opened, and what they may be.

`data_files` reads arrays and objects from them, `postprocess.open_results` netCDF,
`postprocess.batch.store` the points of a batch. A file is data: nothing in it names code, or
another file. What it declares is compared with its size before memory is taken. Whatever is wrong
with it is a `DamagedFileError`.
"""

import io
import json
import lzma
import os
import re
import stat
import struct
import zipfile
import zlib
from collections.abc import Mapping
from pathlib import Path
from typing import IO, Any

LARGEST = 2**32  # of a file [bytes]
LARGEST_TEXT = 2**28  # of JSON, whose objects take some twenty times its size [bytes]
# bytes of content that a byte of a file may stand for: of npz files, whose shipped ones have up to
# 3, and of LZMA in them and of summaries, where tables of traction have 30
DEFLATED = 4
PACKED = 200
DEFLATE = zipfile.ZIP_DEFLATED
# a terminal acts upon these, or they turn the direction of writing; tabs and line ends are text
CONTROL = "\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f\u200e\u200f\u202a-\u202e\u2066-\u2069"
CONTROLS = re.compile(f"[{CONTROL}]")
ESCAPED = re.compile(rf"[{CONTROL}]|\\[bfe]|\\[uUx](?:0*[01789][0-9a-fA-F]|20[0-6])")
DAMAGE = (
    zipfile.BadZipFile,
    zlib.error,
    lzma.LZMAError,
    struct.error,
    LookupError,
    TypeError,
    ValueError,
    ArithmeticError,
    EOFError,
    AttributeError,
    RuntimeError,  # of an archive that is encrypted or of unknown compression, and of nesting
)


class DamagedFileError(ValueError):
    """A file that is not as this program writes it."""


def open_file(path: Path, most: int = LARGEST) -> IO[bytes]:
    """Open a file of others: a regular one, no device or pipe, of a size that fits.

    Parameters
    ----------
    path : Path
        file to read
    most : int, default LARGEST
        largest size [bytes]

    Returns
    -------
    IO[bytes]
        open file

    Raises
    ------
    DamagedFileError
        if it is no regular file, or a larger one; OSError where it cannot be opened
    """
    state = os.stat(path)
    if stat.S_ISDIR(state.st_mode):
        raise IsADirectoryError(21, "Is a directory", str(path))
    if not stat.S_ISREG(state.st_mode):
        raise DamagedFileError(f"{path}: is no regular file")
    if state.st_size > most:
        raise DamagedFileError(f"{path}: {state.st_size} bytes; {most} at most are read")
    return path.open("rb")


def read_file(path: Path, most: int = LARGEST) -> bytes:
    """Read a file of others as `open_file` opens it.

    Parameters
    ----------
    path : Path
        file to read
    most : int, default LARGEST
        largest size [bytes]

    Returns
    -------
    bytes
        its content
    """
    with open_file(path, most) as stream:
        return stream.read(most + 1)


def read_json(path: Path) -> Any:
    """Read a JSON file.

    Parameters
    ----------
    path : Path
        file to read

    Returns
    -------
    Any
        the document

    Raises
    ------
    DamagedFileError
        if it is no JSON; OSError where it cannot be opened
    """
    return parse_json(read_file(path, LARGEST_TEXT), str(path))


def parse_json(content: str | bytes, name: str) -> Any:
    """Read JSON that a file of others holds.

    Parameters
    ----------
    content : str | bytes
        the text, bytes in UTF-8
    name : str
        name of the file in messages

    Returns
    -------
    Any
        the document

    Raises
    ------
    DamagedFileError
        if it is no JSON
    """
    try:
        text = content if isinstance(content, str) else content.decode("utf-8")
        document = json.loads(text)
        if ESCAPED.search(text) and has_control_characters(document):
            raise ValueError("control characters in a text")
    except DAMAGE as problem:
        raise DamagedFileError(f"{name} is damaged: {problem}") from problem
    return document


def has_control_characters(document: Any) -> bool:
    """Tell whether a text of a document acts upon a terminal.

    Parameters
    ----------
    document : Any
        text, or tables and lists of them

    Returns
    -------
    bool
        true if one does
    """
    if isinstance(document, dict):
        return any(map(has_control_characters, (*document, *document.values())))
    if isinstance(document, list):
        return any(map(has_control_characters, document))
    return isinstance(document, str) and CONTROLS.search(document) is not None


def visible(text: str) -> str:
    """A text for a terminal, its control characters written out.

    Parameters
    ----------
    text : str
        any text

    Returns
    -------
    str
        the text without them
    """
    return CONTROLS.sub(lambda found: ascii(found[0])[1:-1], text)


def one_line(text: str) -> str:
    """A text for one line of a terminal, ends of lines in it written out, as of a file's name.

    Parameters
    ----------
    text : str
        any text

    Returns
    -------
    str
        the line
    """
    return visible(text).replace("\r", "\\r").replace("\n", "\\n")


def entries_of(
    stream: IO[bytes], name: str, fault: str = "damaged", most: int = DEFLATED
) -> dict[str, bytes]:
    """Read the files of a zip archive, which may declare no more than it holds.

    Parameters
    ----------
    stream : IO[bytes]
        archive, open for bytes
    name : str
        name of the file in messages
    fault : str, default 'damaged'
        message where it is none
    most : int, default DEFLATED
        bytes of content that a byte of the archive may stand for

    Returns
    -------
    dict[str, bytes]
        contents by their names
    """
    size = stream.seek(0, os.SEEK_END)
    try:
        with zipfile.ZipFile(stream) as archive:
            entries = archive.infolist()
            packed = sum(entry.compress_size for entry in entries)
            if packed > size or sum(entry.file_size for entry in entries) > most * size:
                raise DamagedFileError(f"{name}: {fault}: declares more than it holds")
            return {entry.filename: archive.read(entry) for entry in entries}
    except DamagedFileError:
        raise
    except DAMAGE as problem:
        raise DamagedFileError(f"{name}: {fault} ({type(problem).__name__})") from problem


def entries_as_bytes(
    entries: Mapping[str, bytes | str], packing: int = zipfile.ZIP_STORED
) -> bytes:
    """Files as the content of a zip archive; equal files give equal archives.

    Parameters
    ----------
    entries : Mapping[str, bytes | str]
        contents by their names
    packing : int, default zipfile.ZIP_STORED
        compression of `zipfile`

    Returns
    -------
    bytes
        content of the archive
    """
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w") as archive:
        for name, content in entries.items():
            archive.writestr(zipfile.ZipInfo(name), content, packing)
    return stream.getvalue()


def unpacked(data: bytes, packing: Mapping[str, Any], size: int) -> bytes:
    """Decompress LZMA into as many bytes as are expected, and no more.

    Parameters
    ----------
    data : bytes
        raw LZMA
    packing : Mapping[str, Any]
        format and filters
    size : int
        bytes expected

    Returns
    -------
    bytes
        content, of this size

    Raises
    ------
    ValueError
        if it has another size, or one beyond what the data can hold
    """
    if not 0 <= size <= PACKED * (len(data) + 2**10):
        raise ValueError("declares more than it holds")
    content = lzma.LZMADecompressor(**packing).decompress(data, max_length=size + 1)
    if len(content) != size:
        raise ValueError("holds another number of bytes than it declares")
    return content


def inflated(data: bytes) -> bytes:
    """Decompress deflated bytes, up to `LARGEST_TEXT`.

    Parameters
    ----------
    data : bytes
        as `zlib.compress` gives them

    Returns
    -------
    bytes
        content

    Raises
    ------
    ValueError
        if they are longer, or end too early
    """
    reader = zlib.decompressobj()
    content = reader.decompress(data, min(PACKED * (len(data) + 2**10), LARGEST_TEXT))
    if not reader.eof:
        raise ValueError("declares more than it holds")
    return content
