from .reading import SIZE_LIMIT as SIZE_LIMIT
from .reading import read as read
