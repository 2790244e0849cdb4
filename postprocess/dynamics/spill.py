"""A file for HDF5 that never fails: what the disk does not take is kept in memory.

An error while HDF5 writes or closes a file leaves it in a state that may end the program later.
The writer asks for the error after each of its steps instead, and closes the file in peace.
"""

import io
from pathlib import Path
from typing import Any


class SpillingFile(io.RawIOBase):
    """A new binary file; `error` is the first that the disk gave."""

    def __init__(self, path: Path) -> None:
        self.error: OSError | None = None
        self._file = path.open("w+b", buffering=0)
        self._spilled: list[tuple[int, bytes]] = []
        self._place = 0

    def check(self) -> None:
        """Raise what the disk has refused so far."""
        if self.error is not None:
            raise self.error

    def write(self, data: Any) -> int:
        """Write to the disk, or keep in memory from the first error on."""
        content = bytes(data)
        if self.error is None:
            try:
                self._write_all(content)
            except OSError as error:
                self.error = error
        if self.error is not None:
            self._spilled.append((self._place, content))
        self._place += len(content)
        return len(content)

    def _write_all(self, content: bytes) -> None:
        self._file.seek(self._place)
        rest = memoryview(content)
        while rest:
            rest = rest[self._file.write(rest) :]

    def readinto(self, buffer: Any) -> int:
        """What was written last at each place, zeros where nothing was."""
        wanted = memoryview(buffer).cast("B")
        size = len(wanted)
        self._file.seek(self._place)
        content = self._file.read(size).ljust(size, b"\0")
        wanted[:] = content
        for start, part in self._spilled:
            first = max(start, self._place)
            last = min(start + len(part), self._place + size)
            if first < last:
                piece = part[first - start : last - start]
                wanted[first - self._place : last - self._place] = piece
        self._place += size
        return size

    def seek(self, offset: int, whence: int = io.SEEK_SET) -> int:
        """Go to a place from the beginning, here or the end [bytes]."""
        start = {io.SEEK_SET: 0, io.SEEK_CUR: self._place, io.SEEK_END: self._size()}[whence]
        self._place = start + offset
        return self._place

    def _size(self) -> int:
        spilled = max((start + len(part) for start, part in self._spilled), default=0)
        return max(self._file.seek(0, io.SEEK_END), spilled)

    def tell(self) -> int:
        """The place [bytes]."""
        return self._place

    def truncate(self, size: int | None = None) -> int:
        """Cut the file, or lengthen it with zeros [bytes]."""
        wanted = self._place if size is None else size
        if self.error is None:
            try:
                return self._file.truncate(wanted)
            except OSError as error:
                self.error = error
        return wanted

    def readable(self) -> bool:
        """It can be read."""
        return True

    def writable(self) -> bool:
        """It can be written."""
        return True

    def seekable(self) -> bool:
        """It has places."""
        return True

    def close(self) -> None:
        """Close the file on the disk."""
        self._file.close()
        super().close()
