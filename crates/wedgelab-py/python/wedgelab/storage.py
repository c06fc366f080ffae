"""Studies in object storage: their folder is mirrored there, so that another machine can go on with it.

Below the address lie ``study.json``, what the study is; ``parts/part-NNNNNN``, the records that are there so far; ``table/part-NNNNNN.parquet``, the
rows of each part that is complete, which together are the table; and at the end ``index.html``. Each object appears whole or not at all.
The package ``obstore`` reaches Amazon S3 and what speaks like it, Google Cloud Storage, Azure and folders.
"""

from __future__ import annotations

import time

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

from ._optional import need
from ._wedgelab import NativeStudyFolder
from .errors import StudyError

__all__: list[str] = []

PAUSE = 60.0
"""Seconds between two times at which what was computed meanwhile is sent: what is lost at most with the machine."""


class _Mirror:
    """The objects of a study beside its folder."""

    def __init__(self, store: Any, native: NativeStudyFolder, path: Path) -> None:
        self.obstore = need("obstore", "object storage", "storage")
        self.errors = (OSError, ValueError, self.obstore.exceptions.BaseError)
        self.store = self._opened(store)
        self.address = store if isinstance(store, str) else repr(self.store)
        self.native = native
        self.path = path
        self.sent: dict[int, int] = {}
        """Bytes of each part that were sent."""
        self.tables: set[int] = set()
        """Parts whose tables are there."""
        self.last = time.monotonic()

    def _opened(self, store: Any) -> Any:
        if not isinstance(store, str):
            return store
        try:
            made = {"mkdir": True} if store.startswith("file:") else {}
            return self.obstore.store.from_url(store, **made)
        except self.errors as error:
            raise self._failed(f"{store!r} is no address of object storage", error) from error

    def _failed(self, message: str, error: Exception) -> StudyError:
        # Without the library's own structures, which follow.
        message = f"{message}: {str(error).partition('Debug source')[0].strip()}"
        help_text = (
            's3://BUCKET/FOLDER, gs://..., az://... or file:///... is expected, or a store of the package obstore; '
            "keys are taken from the environment (AWS_ACCESS_KEY_ID, ...). What the folder has is kept, and the same call goes on"
        )
        return StudyError(message, f"  × {message}\n  help: {help_text}")

    def _names(self, folder: str) -> dict[int, str]:
        """The objects of parts in a folder, by part."""
        found = {}
        for chunk in self.obstore.list(self.store, prefix=folder):
            for meta in chunk:
                number = meta["path"].rpartition("part-")[2].removesuffix(".parquet")
                if number.isdigit():
                    found[int(number)] = meta["path"]
        return found

    def _get(self, name: str) -> bytes:
        return bytes(self.obstore.get(self.store, name).bytes())

    def pull(self) -> None:
        """Brings the records that the folder lacks; says what the study is where nothing says it yet."""
        try:
            there = self._get("study.json")
        except FileNotFoundError:
            there = None
        except self.errors as error:
            raise self._failed(f"{self.address} cannot be read", error) from error
        if there is None:
            self._put("study.json", (self.path / "study.json").read_bytes())
        else:
            self.native.compare(Path(self.address), there.decode("utf-8", "replace"))
        try:
            self.tables = set(self._names("table"))
            for part, name in sorted(self._names("parts").items()):
                if part >= self.native.parts:
                    continue
                records = self._get(name)
                if self.native.missing(part):
                    self.native.keep_new(part, records)
                if self._size(part) == len(records):
                    self.sent[part] = len(records)
        except self.errors as error:
            raise self._failed(f"{self.address} cannot be read", error) from error

    def _put(self, name: str, content: bytes) -> None:
        try:
            self.obstore.put(self.store, name, content)
        except self.errors as error:
            raise self._failed(f"{self.address} cannot be written to", error) from error

    def _file(self, part: int) -> Path:
        return self.path / "parts" / f"part-{part:06}"

    def _size(self, part: int) -> int:
        file = self._file(part)
        return file.stat().st_size if file.exists() else 0

    def push(self) -> None:
        """Sends what changed since the last time."""
        for part in range(self.native.parts):
            size = self._size(part)
            if size != self.sent.get(part, 0):
                content = self._file(part).read_bytes()
                self._put(f"parts/part-{part:06}", content)
                self.sent[part] = len(content)
            if size > 0 and part not in self.tables and not self.native.missing(part):
                self._put(f"table/part-{part:06}.parquet", self.native.part_table(part))
                self.tables.add(part)

    def now_and_then(self) -> None:
        """Sends what changed if that is long ago."""
        if time.monotonic() - self.last >= PAUSE:
            self.push()
            self.last = time.monotonic()

    def end(self) -> None:
        """Sends all, and the page."""
        self.push()
        page = self.path / "index.html"
        if page.exists():
            self._put("index.html", page.read_bytes())


@contextmanager
def mirrored(store: Any, native: NativeStudyFolder, path: Path) -> Iterator[Callable[[], None]]:
    """Brings what is in storage, and sends what is computed while the block runs: now and then when what it gives is called, and at the end, also
    after Ctrl-C. ``None``: the folder alone."""
    if store is None:
        yield lambda: None
        return
    mirror = _Mirror(store, native, path)
    mirror.pull()
    try:
        yield mirror.now_and_then
    except BaseException:
        mirror.push()
        raise
    mirror.end()
