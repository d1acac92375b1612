"""Tables of results: columns by name, as arrays."""

import csv
import html
import io

import numpy as np

__all__ = ["Table"]


class Table:
    """A table whose columns are arrays: of numbers where every entry is one or empty (NaN), else of
    texts. Identifiers that are all there are whole numbers.

    table["x"] or table.x is a column, table[mask] the rows that a mask chooses.
    """

    def __init__(self, columns):
        self._columns = {name: _array(name, column) for name, column in columns.items()}
        if len({len(column) for column in self._columns.values()}) > 1:
            raise ValueError("the columns of a table have one length")

    @classmethod
    def from_csv(cls, text):
        """Reads a text with a header row."""
        rows = list(csv.reader(io.StringIO(text)))
        if not rows:
            return cls({})
        header, *rows = rows
        columns = zip(*rows) if rows else [()] * len(header)
        return cls({name: _typed(name, column) for name, column in zip(header, columns)})

    def to_csv(self):
        """The table as text; numbers read back to the same doubles."""
        out = io.StringIO()
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(self._columns)
        writer.writerows(zip(*(map(_written, column.tolist()) for column in self._columns.values())))
        return out.getvalue()

    def to_pandas(self):
        """The same as a pandas.DataFrame."""
        import pandas

        return pandas.DataFrame(self._columns)

    @property
    def columns(self):
        """The names of the columns."""
        return list(self._columns)

    def __len__(self):
        return len(next(iter(self._columns.values()), ()))

    def __getitem__(self, key):
        if isinstance(key, str):
            return self._columns[key]
        return Table({name: column[key] for name, column in self._columns.items()})

    def __getattr__(self, name):
        if not name.startswith("_") and name in self._columns:
            return self._columns[name]
        raise AttributeError(f"no column {name!r}; there are {', '.join(self._columns)}")

    def __contains__(self, name):
        return name in self._columns

    def __dir__(self):
        return sorted(set(super().__dir__()) | set(self._columns))

    def __repr__(self):
        return f"<Table of {len(self)} rows: {', '.join(self._columns)}>"

    def _repr_html_(self, most=20):
        def row(cells, tag):
            return "<tr>" + "".join(f"<{tag}>{html.escape(cell)}</{tag}>" for cell in cells) + "</tr>"

        shown = [column[:most].tolist() for column in self._columns.values()]
        body = "".join(row(map(_shown, cells), "td") for cells in zip(*shown))
        rest = f"<p>… {len(self)} rows</p>" if len(self) > most else ""
        return f"<table><thead>{row(self._columns, 'th')}</thead><tbody>{body}</tbody></table>{rest}"


_TEXTS = {"name", "kind", "sensor", "class", "status", "filter"}
_IDENTIFIERS = {"truth_id", "track_id"}


def _array(name, column):
    array = np.asarray(column)
    if name in _IDENTIFIERS and array.dtype == float and np.all(array == np.trunc(array)):
        return array.astype(np.int64)  # an empty entry is NaN, which equals nothing
    return array


def _typed(name, column):
    if name in _TEXTS:  # even where all are empty
        return np.array(column, dtype=object)
    try:
        return np.array([float(entry) if entry else np.nan for entry in column], dtype=float)
    except ValueError:
        return np.array(column, dtype=object)


def _written(value):
    if isinstance(value, float):
        return "" if value != value else repr(value).removesuffix(".0")
    return value


def _shown(value):
    return f"{value:.5g}" if isinstance(value, float) else str(value)
