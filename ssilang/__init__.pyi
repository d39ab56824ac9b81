from ssilang.api.building import Builder as Builder
from ssilang.api.errors import Error as Error
from ssilang.api.errors import MissingKey as MissingKey
from ssilang.api.errors import Notice as Notice
from ssilang.api.result import Result as Result
from ssilang.api.running import check as check
from ssilang.api.running import run as run
from ssilang.api.sweeps import sweep as sweep

__version__: str
