from .collapsed import CollapsedGraph as CollapsedGraph
from .collapsed import edge_collapsed_graph as edge_collapsed_graph
from .collapsed import edge_collapsed_graphs as edge_collapsed_graphs
from .collapsed import has_linear_spanning_subtrees as has_linear_spanning_subtrees
from .layering import find_layering as find_layering
from .procedure import PaperRun as PaperRun
from .procedure import find_immersion as find_immersion
from .procedure import run_paper as run_paper
