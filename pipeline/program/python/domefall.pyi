# Types of the module domefall, for editors and type checkers; help(domefall) is its manual.
import os
import pathlib
from typing import Literal, Optional, Tuple, Union

import numpy as np
import numpy.typing as npt

__version__: str
SECONDS_PER_SOLAR_MASS: float

Method = Literal["table", "exact", "rk4", "dopri5", "rkf78", "binet-dopri5", "binet-rkf78"]
Size = Union[int, str, Tuple[int, int], None]

class InputError(ValueError): ...
class TemporaryError(OSError): ...

class Show:
    def __init__(self, file: Union[str, os.PathLike[str]], threads: int = 0) -> None: ...
    @property
    def file(self) -> pathlib.Path: ...
    @property
    def title(self) -> str: ...
    @property
    def frames(self) -> int: ...
    @property
    def frames_per_second(self) -> float: ...
    @property
    def mass_solar(self) -> Optional[float]: ...
    @property
    def projection(self) -> str: ...
    @property
    def size(self) -> Tuple[int, int]: ...
    def states(self, frames: Optional[npt.ArrayLike] = None) -> npt.NDArray[np.void]: ...
    def frame(self, number: int, size: Size = None) -> npt.NDArray[np.float32]: ...
    def graded(self, number: int, size: Size = None) -> npt.NDArray[np.uint16]: ...

def trace(
    r: npt.ArrayLike,
    delta: Optional[npt.ArrayLike] = None,
    *,
    edge: Optional[npt.ArrayLike] = None,
    offset: Optional[npt.ArrayLike] = None,
    observer: npt.ArrayLike = "rain",
    method: Method = "table",
    tolerance: float = 1e-10,
) -> npt.NDArray[np.void]: ...

def trace_spin(
    r: npt.ArrayLike,
    delta: Optional[npt.ArrayLike] = None,
    *,
    spin: npt.ArrayLike = 0,
    charge: npt.ArrayLike = 0,
    theta: npt.ArrayLike = np.pi / 2,
    eta: npt.ArrayLike = 0,
    edge: Optional[npt.ArrayLike] = None,
    offset: Optional[npt.ArrayLike] = None,
) -> npt.NDArray[np.void]: ...

def trace_wormhole(
    l: npt.ArrayLike,
    delta: Optional[npt.ArrayLike] = None,
    *,
    profile: npt.ArrayLike = "ellis",
    rho: npt.ArrayLike = 1,
    a: Optional[npt.ArrayLike] = None,
    m: Optional[npt.ArrayLike] = None,
    edge: Optional[npt.ArrayLike] = None,
    offset: Optional[npt.ArrayLike] = None,
    method: Literal["table", "exact"] = "table",
) -> npt.NDArray[np.void]: ...
