from .outline_files import save as save
from .reading import SIZE_LIMIT as SIZE_LIMIT
from .reading import read as read
from .reading import read_each as read_each
