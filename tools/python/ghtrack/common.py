"""What goes with every filter: a record of its attributes over time, the noise of its model."""

import copy
import inspect

import numpy as np

__all__ = ["Q_discrete_white_noise", "Saver"]


class Saver:
    """Records all attributes and properties of an object at each save().

    The lists are attributes of the saver, and items: saver.x, saver["x"].

    Parameters
    ----------
    kf : the object, such as a filter
    save_current : whether to begin with a save()
    skip_private : leave out names that begin with "_"
    skip_callable : leave out attributes that can be called
    ignore : names to leave out
    """

    def __init__(self, kf, save_current=False, skip_private=False, skip_callable=False, ignore=()):
        self._kf = kf
        self._lists = {}
        self._skip_private, self._skip_callable = skip_private, skip_callable
        self._ignore = tuple(ignore)
        self._len = 0
        members = inspect.getmembers(type(kf), lambda member: isinstance(member, property))
        self.properties = [member for member in members if member[0] not in self._ignore]
        if save_current:
            self.save()

    def _is_wanted(self, name, value):
        if name in self._ignore or (self._skip_private and name.startswith("_")):
            return False
        return not (self._skip_callable and callable(value))

    def save(self):
        """Appends the present value of everything."""
        # Properties first: reading one may set an attribute.
        values = {name: getattr(self._kf, name) for name, _ in self.properties}
        values.update(
            (name, value)
            for name, value in self._kf.__dict__.items()
            if self._is_wanted(name, value)
        )
        for name, value in values.items():
            self._lists.setdefault(name, []).append(copy.deepcopy(value))
        self.__dict__.update(self._lists)
        self._len += 1

    def to_array(self, flatten=False):
        """Turns the lists into arrays.

        Raises ValueError, and keeps the lists, if entries of one list differ in shape.
        """
        arrays = {}
        for name, values in self._lists.items():
            if len({np.shape(value) for value in values}) > 1:
                self.__dict__.update(self._lists)
                raise ValueError(f"could not convert {name} into an array: its shape changes")
            arrays[name] = np.array(values)
        self.__dict__.update(arrays)
        if flatten:
            self.flatten()

    def flatten(self):
        """Turns arrays of column vectors into arrays with one dimension less."""
        for name in self.keys:
            array = self.__dict__[name]
            if isinstance(array, np.ndarray) and array.ndim == 3 and array.shape[2] == 1:
                array = array.reshape(array.shape[:2])
            if isinstance(array, np.ndarray) and array.ndim == 2 and array.shape[1] == 1:
                array = array.ravel()
            self.__dict__[name] = array

    @property
    def keys(self):
        """Names of what is recorded."""
        return list(self._lists)

    def __getitem__(self, name):
        return self._lists[name]

    def __setitem__(self, name, values):
        self._lists[name] = values
        self.__dict__[name] = values

    def __len__(self):
        return self._len

    def __repr__(self):
        return f"<Saver of {type(self._kf).__name__}: {len(self)} times {' '.join(self.keys)}>"


def Q_discrete_white_noise(dim, dt=1.0, var=1.0, block_size=1, order_by_dim=True):
    """Process noise of a model whose highest derivative is white noise, constant over each step.

    With dim 2, 3 or 4 the noise enters the state as g = (dt²/2, dt), (dt²/2, dt, 1) or
    (dt³/6, dt²/2, dt, 1), and Q is var g gᵀ (Bar-Shalom, Li & Kirubarajan, ch. 6.3).

    Parameters
    ----------
    block_size : how many such states there are side by side
    order_by_dim : whether the state holds them one after the other (x vx y vy), or derivative by
        derivative (x y vx vy)
    """
    enters = {2: (dt**2 / 2, dt), 3: (dt**2 / 2, dt, 1.0), 4: (dt**3 / 6, dt**2 / 2, dt, 1.0)}
    if dim not in enters:
        raise ValueError("dim must be 2, 3 or 4")
    block = var * np.outer(enters[dim], enters[dim])
    return np.kron(np.eye(block_size), block) if order_by_dim else np.kron(block, np.eye(block_size))
