"""The commands of `oilfilm`; importing it registers them in the order of the help."""

from .app import app  # isort: skip
from . import compute  # noqa: F401  # isort: skip
from . import dynamics  # noqa: F401  # isort: skip
from .over_time import transient  # noqa: F401  # isort: skip
from .over_time import vibration  # noqa: F401  # isort: skip
from . import batch  # noqa: F401  # isort: skip
from . import optimise  # noqa: F401  # isort: skip
from . import view  # noqa: F401  # isort: skip
from . import documents  # noqa: F401  # isort: skip
from . import files  # noqa: F401  # isort: skip
from . import verify  # noqa: F401  # isort: skip

__all__ = ["app"]
