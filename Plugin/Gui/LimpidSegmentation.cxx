// SPDX-FileCopyrightText: Copyright (c) Limpid developers
// SPDX-License-Identifier: BSD-3-Clause
#include "LimpidSegmentation.h"

#include "LimpidDisplays.h"
#include "LimpidLabels.h"
#include "LimpidOptimizedVolumes.h"
#include "LimpidStructures.h"
#include "pqActiveObjects.h"
#include "pqApplicationCore.h"
#include "pqCoreUtilities.h"
#include "pqFileDialog.h"
#include "pqObjectBuilder.h"
#include "pqOutputPort.h"
#include "pqPipelineSource.h"
#include "pqRenderView.h"
#include "pqServer.h"
#include "pqUndoStack.h"
#include "vtkDataObject.h"
#include "vtkNew.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkPVDataSetAttributesInformation.h"
#include "vtkSMPVRepresentationProxy.h"
#include "vtkSMParaViewPipelineControllerWithRendering.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMRenderViewProxy.h"
#include "vtkSMRepresentationProxy.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMTrace.h"

#include <QCoreApplication>
#include <QFileInfo>
#include <QIcon>
#include <QMap>
#include <QScrollArea>
#include <QScrollBar>

#include <set>
#include <string>
#include <vector>

namespace
{
const char* const FILES = "*.nii *.nii.gz *.nrrd *.nhdr *.mha *.mhd";

QString Say(const char* text)
{
  return QCoreApplication::translate("LimpidSegmentation", text);
}

// Returns the file that a source reads by a reader of ParaView that may ignore where it places the
// image; empty: the source is no such reader.
std::string FileWithPlacement(vtkSMProxy* source)
{
  if (std::string(source->GetXMLName()) == "SegmentationReader")
  {
    return "";
  }
  for (const char* property : { "FileName", "FileNames" })
  {
    const vtkSMPropertyHelper name(source, property, /*quiet=*/true);
    const char* path = source->GetProperty(property) ? name.GetAsString() : nullptr;
    const QString end = QFileInfo(path ? path : "").suffix().toLower();
    if (std::set<QString>({ "nii", "nrrd", "nhdr", "mha", "mhd" }).count(end) != 0)
    {
      return path;
    }
  }
  return "";
}

// Creates a filter that adds the labels of a file to an image. Null if it has none.
pqPipelineSource* AddStructures(pqOutputPort* image, const QStringList& files)
{
  pqObjectBuilder* builder = pqApplicationCore::instance()->getObjectBuilder();
  pqServer* server = image->getServer();
  pqPipelineSource* reader = builder->createReader("sources", "SegmentationReader", files, server);
  reader->setModifiedState(pqProxy::UNMODIFIED);
  reader->updatePipeline(); // the filter chooses among its arrays
  QMap<QString, QList<pqOutputPort*>> inputs;
  inputs["Input"] << image;
  inputs["Structures"] << reader->getOutputPort(0);
  pqPipelineSource* filter = builder->createFilter("filters", "AddStructures", inputs, server);
  {
    SM_SCOPED_TRACE(PropertiesModified).arg("proxy", filter->getProxy());
    vtkSMPropertyHelper(filter->getProxy(), "ImageFile")
      .Set(FileWithPlacement(image->getSource()->getProxy()).c_str());
    filter->getProxy()->UpdateVTKObjects();
  }
  filter->setModifiedState(pqProxy::UNMODIFIED);
  filter->updatePipeline();
  vtkPVDataInformation* data = filter->getOutputPort(0)->getDataInformation();
  return data->GetArrayInformation("Structure", vtkDataObject::POINT) ? filter : nullptr;
}

// Colors a display as another one of the same points, or else by the first array.
void ColorLike(vtkSMProxy* display, vtkSMProxy* other, vtkPVDataInformation* data)
{
  const char* name = nullptr;
  int association = vtkDataObject::POINT;
  if (other)
  {
    vtkSMPropertyHelper colored(other, "ColorArrayName");
    name = colored.GetInputArrayNameToProcess();
    association = colored.GetInputArrayAssociation();
  }
  if (!name || !*name)
  {
    association = vtkDataObject::POINT;
    vtkPVDataSetAttributesInformation* points = data->GetPointDataInformation();
    name = points->GetNumberOfArrays() > 0 ? points->GetArrayInformation(0)->GetName() : "";
  }
  if (auto* representation = vtkSMPVRepresentationProxy::SafeDownCast(display))
  {
    representation->SetScalarColoring(name, association);
  }
}

// Sets the labels of a display, and a row for each of them.
void SetStructures(vtkSMProxy* display)
{
  SM_SCOPED_TRACE(PropertiesModified).arg("proxy", display);
  vtkSMPropertyHelper(display, "StructureArray")
    .SetInputArrayToProcess(vtkDataObject::POINT, "Structure");
  LimpidStructureModel rows(nullptr);
  rows.add(LabelsOf(display).Looks, /*important=*/false);
  vtkSMPropertyHelper texts(display, "Structures");
  unsigned int text = 0;
  for (const QVariant& value : rows.texts())
  {
    texts.Set(text++, value.toString().toUtf8().data());
  }
  std::vector<double> colors; // all at once: the panel takes whole rows only
  for (const QVariant& value : rows.colors())
  {
    colors.push_back(value.toDouble());
  }
  if (!colors.empty())
  {
    vtkSMPropertyHelper(display, "LabelColors")
      .Set(colors.data(), static_cast<unsigned int>(colors.size()));
  }
  display->UpdateVTKObjects();
}

// Shows the image with its labels in place of the image alone.
void ShowStructures(pqOutputPort* labelled, pqOutputPort* image, pqView* view)
{
  vtkNew<vtkSMParaViewPipelineControllerWithRendering> controller;
  auto* source = vtkSMSourceProxy::SafeDownCast(image->getSource()->getProxy());
  auto* filter = vtkSMSourceProxy::SafeDownCast(labelled->getSource()->getProxy());
  vtkSMViewProxy* where = view->getViewProxy();
  vtkSMProxy* former = where->FindRepresentation(source, image->getPortNumber());
  const bool isFirst = view->getNumberOfVisibleRepresentations() == 0;
  vtkSMProxy* display = controller->Show(filter, labelled->getPortNumber(), where);
  if (former && IsOptimizedVolume(former))
  {
    CopyDisplay(display, former);
  }
  else
  {
    vtkSMRepresentationProxy::SetRepresentationType(display, "Optimized Volume");
    ColorLike(display, former, image->getDataInformation());
  }
  SetStructures(display);
  if (former)
  {
    controller->Hide(source, image->getPortNumber(), where);
  }
  if (isFirst)
  {
    view->resetDisplay();
  }
}
}

bool CanOpenSegmentation()
{
  pqOutputPort* port = pqActiveObjects::instance().activePort();
  return port && port->getSource()->modifiedState() != pqProxy::UNINITIALIZED &&
    port->getDataInformation()->GetDataSetType() == VTK_IMAGE_DATA;
}

bool OpenSegmentation()
{
  pqOutputPort* image = pqActiveObjects::instance().activePort();
  auto* view = qobject_cast<pqRenderView*>(pqActiveObjects::instance().activeView());
  pqFileDialog dialog(image->getServer(), pqCoreUtilities::mainWidget(), Say("Open Segmentation"),
    QString(), Say("Segmentations") + " (" + FILES + ")", /*groupFiles=*/false);
  dialog.setObjectName("OpenSegmentationDialog");
  dialog.setFileMode(pqFileDialog::ExistingFile);
  if (dialog.exec() != QDialog::Accepted)
  {
    return false;
  }
  SCOPED_UNDO_SET(Say("Open Segmentation"));
  pqPipelineSource* filter = AddStructures(image, dialog.getSelectedFiles());
  if (!filter || !view)
  {
    return false;
  }
  ShowStructures(filter->getOutputPort(0), image, view);
  pqActiveObjects::instance().setActiveSource(filter);
  view->render();
  return true;
}

void ScrollToStructures()
{
  for (auto* area : pqCoreUtilities::mainWidget()->findChildren<QScrollArea*>("scrollArea"))
  {
    if (auto* table = area->findChild<LimpidStructures*>())
    {
      area->verticalScrollBar()->setValue(table->mapTo(area->widget(), QPoint()).y());
    }
  }
}

QIcon SegmentationIcon()
{
  return QIcon(":/Limpid/Icons/OpenSegmentation.svg");
}

QString SegmentationToolTip()
{
  return Say("Add the labels of a segmentation (NIfTI, NRRD or MetaImage) to the active image, and "
             "show it as an optimized volume. Choose in its table of structures what matters.");
}
