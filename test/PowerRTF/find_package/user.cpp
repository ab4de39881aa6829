#include <CGAL/PowerRTF/Remeshing_options.h>

int main()
{
  return CGAL::PowerRTF::Remeshing_options().number_of_samples == 3000 ? 0 : 1;
}
