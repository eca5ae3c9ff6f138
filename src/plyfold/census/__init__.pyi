from .columns import census_table as census_table
from .page import census_page as census_page
from .plane_curves import PlaneCurves as PlaneCurves
from .plane_curves import plane_curves as plane_curves
from .summary import Summary as Summary
