from .disk import check_ball_mesh as check_ball_mesh
from .disk import check_disk_mesh as check_disk_mesh
from .disk import check_surface_mesh as check_surface_mesh
from .immersed import check_immersed_disk as check_immersed_disk
from .immersed import check_immersed_surface as check_immersed_surface
from .layered import check_layered as check_layered
from .solid import check_solid as check_solid
from .surface import check_surface as check_surface
